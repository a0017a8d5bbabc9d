// The keys for the motion of a scenario's target: [target.trajectory].
#pragma once

#include <memory>
#include <string>

#include "base/config/config_section.h"
#include "geometry/wgs84.h"
#include "sim/world/trajectory.h"

namespace ols::sim {

// Where the trajectory is: `origin`, the site's, must have been read already; file names are
// relative to `folder`.
struct TrajectoryPlace {
  const Geodetic& origin;
  std::string folder;
};

config::Section trajectory_section(std::shared_ptr<const Trajectory>& trajectory,
                                   const TrajectoryPlace& place);

}  // namespace ols::sim
