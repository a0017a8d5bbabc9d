// A user's own map: square pictures (tiles) in Web Mercator projection, by zoom level, column from
// the west and row from the north.
#pragma once

#include <array>
#include <optional>
#include <string>

namespace ols::console {

struct MapInfo {
  std::string name, attribution;
  int min_zoom = 0, max_zoom = 22;
  std::array<double, 4> bounds_deg{-180.0, -85.0511, 180.0, 85.0511};  // west, south, east, north
};

struct TileAddress {
  int zoom = 0, column = 0, row = 0;
};

inline constexpr int kMostZoom = 24;
inline constexpr std::size_t kMostTileBytes = 4'000'000;

class TileStore {
 public:
  virtual ~TileStore() = default;
  virtual const MapInfo& info() const = 0;
  // The bytes of a picture that a browser can show; nullopt if the map has no such tile. Throws
  // std::runtime_error; the message says what is damaged.
  virtual std::optional<std::string> tile(const TileAddress& address) = 0;
};

// Whether zoom, column and row are within the tiling.
bool is_address(const TileAddress& address);
// The content type of a picture, such as "image/png", from the picture's first bytes; empty:
// browsers cannot show it.
std::string picture_type(const std::string& bytes);
// Limits the values that a file states about itself to possible ones.
MapInfo plausible(MapInfo info);

}  // namespace ols::console
