#include "console/maps/tile_folder.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <stdexcept>

#include "base/files/small_file.h"

namespace ols::console {
namespace {

namespace fs = std::filesystem;
constexpr std::array kSuffixes{".png", ".jpg", ".jpeg", ".webp"};

std::optional<int> whole(const std::string& text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace

TileFolder::TileFolder(const std::string& path) : path_(path), suffix_(kSuffixes[0]) {
  info_.name = fs::path(path).filename().string();
  info_.min_zoom = kMostZoom + 1;
  info_.max_zoom = -1;
  for (const auto& entry : fs::directory_iterator(path)) {
    const auto zoom = whole(entry.path().filename().string());
    if (!zoom || *zoom < 0 || *zoom > kMostZoom || !entry.is_directory()) continue;
    info_.min_zoom = std::min(info_.min_zoom, *zoom);
    info_.max_zoom = std::max(info_.max_zoom, *zoom);
  }
  if (info_.max_zoom < 0) throw std::runtime_error("has no folder of a zoom level, 0 to 24");
  info_ = plausible(info_);
}

std::optional<std::string> TileFolder::tile(const TileAddress& a) {
  const std::string stem = path_ + "/" + std::to_string(a.zoom) + "/" + std::to_string(a.column) +
                           "/" + std::to_string(a.row);
  if (fs::exists(stem + suffix_)) return read_small_file(stem + suffix_, kMostTileBytes);
  for (const char* suffix : kSuffixes) {
    if (!fs::exists(stem + suffix)) continue;
    suffix_ = suffix;
    return read_small_file(stem + suffix, kMostTileBytes);
  }
  return std::nullopt;
}

}  // namespace ols::console
