// The range in which a mount can point, in its own angles. Pure.
#pragma once

#include <vector>

#include "edge/mount/keep_out.h"
#include "geometry/angles.h"
#include "geometry/kinematic_chain.h"

namespace ols::mount {

// A station reports angles in counts. For a mount without an encoder, a count has this size.
inline constexpr double kVirtualCount_rad = radians(1e-4);

struct Limits {  // [rad]
  double pan_min_rad = -2.7, pan_max_rad = 2.7;
  double tilt_min_rad = -0.8, tilt_max_rad = 0.5;
  std::vector<KeepOut> keep_out = {};  // regions that the mount never enters or crosses
  // The size of a count on each axis; 0 if it is not known yet.
  PanTilt count = {};
};

AngleBox travel(const Limits& limits);

enum class Reach { kDirect, kLongWayRound, kUnreachable };

// Whether the mount can point there. Pan angles that differ by 2 pi are the same direction. Sets
// `angles` to those that are reached by the shortest path from `now`. kLongWayRound: the path turns
// in the other direction, or goes around a keep-out region.
Reach reach(const Limits& limits, const PanTilt& now, PanTilt& angles);

}  // namespace ols::mount
