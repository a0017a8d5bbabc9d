// The range in which a mount can point, in the mount's own angles. Pure.
#pragma once

#include <vector>

#include "edge/mount/keep_out.h"
#include "geometry/angles.h"
#include "geometry/kinematic_chain.h"

namespace ols::mount {

// The size of a count for mounts that do not report counts. It is needed because a station reports
// all angles in counts.
inline constexpr double kVirtualCount_rad = radians(1e-4);

struct Limits {  // [rad]
  double pan_min_rad = -2.7, pan_max_rad = 2.7;
  double tilt_min_rad = -0.8, tilt_max_rad = 0.5;
  std::vector<KeepOut> keep_out = {};  // regions that the mount must not enter or cross
  // The size of a count on each axis; 0 if it is not known yet.
  PanTilt count = {};
};

AngleBox travel(const Limits& limits);

enum class Reach { kDirect, kLongWayRound, kUnreachable };

// Whether the mount can point at `angles`. Pan angles that differ by 2 pi are the same direction;
// reach() sets `angles` to the one that the shortest path from `now` reaches. kLongWayRound: the
// path goes the longer way in pan, or around a keep-out region.
Reach reach(const Limits& limits, const PanTilt& now, PanTilt& angles);

}  // namespace ols::mount
