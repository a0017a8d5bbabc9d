// The limits within which a station accepts slews and operators' commands. The fusion and ols-ctl
// send only commands within these limits.
#pragma once

#include "geometry/angles.h"

namespace ols {

inline constexpr double kSlewRateLimit_rad_s = 1.5;  // about each axis
// The largest time from now to the instant for which a slew is meant. The instant may be in the
// past or in the future.
inline constexpr double kSlewLead_s = 1.0;

// The longest time for which an occlusion notice (the land hides a target) may hold.
inline constexpr double kOcclusionHolds_s = 15.0;

// The largest pan and tilt angles, positive or negative, as the PTU reports them. A larger angle is
// a typing error: the unit would make whole turns.
inline constexpr double kPointPanLimit_rad = radians(360.0);
inline constexpr double kPointTiltLimit_rad = radians(180.0);

// Joystick commands: the largest rate about each axis, and how long one command keeps the unit in
// motion.
inline constexpr double kRateLimit_rad_s = 1.5;
inline constexpr double kRateLease_s = 0.3;

}  // namespace ols
