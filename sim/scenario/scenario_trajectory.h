// The keys for the motion of a scenario's target: [target.trajectory].
#pragma once

#include <memory>
#include <string>

#include "base/config/config_section.h"
#include "geometry/wgs84.h"
#include "sim/world/trajectory.h"

namespace ols::sim {

// `origin`: the site's origin, which must have been read before the trajectory. `folder`: file
// names are relative to it.
struct TrajectoryPlace {
  const Geodetic& origin;
  std::string folder;
};

config::Section trajectory_section(std::shared_ptr<const Trajectory>& trajectory,
                                   const TrajectoryPlace& place);

}  // namespace ols::sim
