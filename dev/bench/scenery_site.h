// Two stations in an imported folder of land that see the same slopes. Pure.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

#include "geometry/wgs84.h"
#include "land/terrain_folder.h"
#include "sim/world/relief.h"

namespace ols::bench {

// The land of a folder with errors of the size that the folder states, and roughness.
class TrueGround {
 public:
  TrueGround(const land::Surface& model, const Geodetic& middle, std::uint64_t seed);

  // In the axes of `frame()`; NaN where nothing is known.
  double height_m(double east_m, double north_m) const;
  // That of the model.
  double model_height_m(double east_m, double north_m) const;
  const LocalFrame& frame() const { return frame_; }

 private:
  const land::Surface& model_;
  LocalFrame frame_;
  sim::ErrorField errors_;
  sim::Waves roughness_;
};

struct ScenerySite {
  Geodetic middle;        // between the stations, on the model's ground
  Eigen::Vector2d along;  // unit vector of the line of view: east, north
  std::array<Eigen::Vector3d, 2> cameras_enu_m;
  double seen = 0.0;  // share of the land at 1 km and at 3 km that the model shows to both
};

// Of many places the one from which most is seen; no slope seen from above or below by more than 5
// degrees. Throws std::invalid_argument if the folder has no such place.
ScenerySite find_site(const land::TerrainFolder& folder, double baseline_m, std::uint64_t seed);

}  // namespace ols::bench
