// The surface of the land around a site: ground, buildings and woods.
#pragma once

#include <optional>

namespace ols::land {

struct SurfaceHeight {
  double height_m = 0.0;  // above the WGS84 ellipsoid
  double sd_m = 0.0;      // 1-sigma of height_m
};

// The height of the land at a place. A surface does not change after its construction; any thread
// may call it.
class Surface {
 public:
  virtual ~Surface() = default;
  // The bare ground; nullopt if no model knows it.
  virtual std::optional<SurfaceHeight> ground(double latitude_rad, double longitude_rad) const = 0;
  // The top surface at the place: the ground, a roof, tree-tops or measured scenery.
  virtual std::optional<SurfaceHeight> top(double latitude_rad, double longitude_rad) const = 0;
};

}  // namespace ols::land
