// A user's own map: square pictures in the Web Mercator tiling, by zoom level, column from the west
// and row from the north.
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
  // A picture that a browser can show; nullopt where the map has none. Throws std::runtime_error;
  // the message says what is damaged.
  virtual std::optional<std::string> tile(const TileAddress& address) = 0;
};

// Whether the tiling has such a tile.
bool is_address(const TileAddress& address);
// "image/png" or similar, from a picture's first bytes; empty: browsers cannot show it.
std::string picture_type(const std::string& bytes);
// Limits what a file states about itself to possible values.
MapInfo plausible(MapInfo info);

}  // namespace ols::console
