#include "console/maps/tile_store.h"

#include <algorithm>
#include <cmath>

#include "base/text/plain_text.h"

namespace ols::console {

bool is_address(const TileAddress& a) {
  if (a.zoom < 0 || a.zoom > kMostZoom || a.column < 0 || a.row < 0) return false;
  const int across = 1 << a.zoom;
  return a.column < across && a.row < across;
}

std::string picture_type(const std::string& bytes) {
  if (bytes.starts_with("\x89PNG")) return "image/png";
  if (bytes.starts_with("\xff\xd8\xff")) return "image/jpeg";
  if (bytes.size() > 12 && bytes.starts_with("RIFF") && bytes.compare(8, 4, "WEBP") == 0)
    return "image/webp";
  return "";
}

MapInfo plausible(MapInfo info) {
  constexpr std::size_t kMostNameBytes = 200;
  const MapInfo whole;
  info.name = plain_text(info.name.substr(0, kMostNameBytes));
  info.attribution = plain_text(info.attribution.substr(0, kMostNameBytes));
  info.min_zoom = std::clamp(info.min_zoom, 0, kMostZoom);
  info.max_zoom = std::clamp(info.max_zoom, info.min_zoom, kMostZoom);
  auto& [west, south, east, north] = info.bounds_deg;
  const bool is_box =
      std::ranges::all_of(info.bounds_deg, [](double v) { return std::isfinite(v); }) &&
      west < east && south < north && std::abs(west) <= 180.0 && std::abs(east) <= 180.0 &&
      std::abs(south) <= 90.0 && std::abs(north) <= 90.0;
  if (!is_box) info.bounds_deg = whole.bounds_deg;
  return info;
}

}  // namespace ols::console
