// The land as a plan sees it: heights of the ground, and what hides targets from planned stations.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "geometry/precision.h"
#include "land/horizon_map.h"
#include "land/terrain_folder.h"

namespace ols::offline {

// Columns of a planned station's map: 35 m at 10 km, about the resolution of elevation models. A
// finer map would cost minutes for hundreds of places.
inline constexpr int kPlanColumns = 1800;

class PlannedLand {
 public:
  // Reads a folder of `ols-land import`. Throws std::runtime_error naming the file that is wrong.
  explicit PlannedLand(const std::string& folder);

  const land::Surface& surface() const { return *folder_.terrain; }
  // Height above the WGS84 ellipsoid; nullopt where the models do not know it.
  std::optional<double> ground_m(const Geodetic& place) const;

  // What the land hides from a camera, up to `reach_m`. Throws std::invalid_argument naming the
  // station if the ground there is unknown or above the camera.
  std::shared_ptr<const land::HorizonMap> look(const std::string& station, const Geodetic& camera,
                                               double reach_m) const;

 private:
  land::TerrainFolder folder_;
};

// A target is in sight if it is more probably visible than not.
void hide_behind(std::shared_ptr<const land::HorizonMap> map, PlannedStation& station);

}  // namespace ols::offline
