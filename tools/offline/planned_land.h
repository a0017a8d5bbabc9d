// The land for the planning of a site: heights of the ground, and what the land hides from planned
// stations.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "geometry/precision.h"
#include "land/horizon_map.h"
#include "land/terrain_folder.h"

namespace ols::offline {

// Number of columns of a planned station's map: one column is 35 m wide at 10 km, about the
// resolution of elevation models. With finer maps, hundreds of places would take minutes.
inline constexpr int kPlanColumns = 1800;

class PlannedLand {
 public:
  // Reads a folder of `ols-land import`. Throws std::runtime_error naming the wrong file.
  explicit PlannedLand(const std::string& folder);

  const land::Surface& surface() const { return *folder_.terrain; }
  // The ground's height above the WGS84 ellipsoid; nullopt: the models do not have it.
  std::optional<double> ground_m(const Geodetic& place) const;

  // The map of what the land hides from a camera, up to a distance of `reach_m`. Throws
  // std::invalid_argument naming the station if the ground there is unknown or above the camera.
  std::shared_ptr<const land::HorizonMap> look(const std::string& station, const Geodetic& camera,
                                               double reach_m) const;

 private:
  land::TerrainFolder folder_;
};

// Lets the map hide targets from a station: a target is in sight if it is more probably visible
// than not.
void hide_behind(std::shared_ptr<const land::HorizonMap> map, PlannedStation& station);

}  // namespace ols::offline
