// The limits within which a station accepts slews, and angles from operators. The fusion and
// ols-ctl keep to them.
#pragma once

#include "geometry/angles.h"

namespace ols {

inline constexpr double kSlewRateLimit_rad_s = 1.5;  // about each axis
// Largest time between the present and the effect of a slew, in either direction.
inline constexpr double kSlewLead_s = 1.0;

// The longest time for which a prediction of what the land hides may hold.
inline constexpr double kOcclusionHolds_s = 15.0;

// The largest pan and tilt, either way, as the PTU counts them. More than this is a typing error:
// the unit would turn by whole turns.
inline constexpr double kPointPanLimit_rad = radians(360.0);
inline constexpr double kPointTiltLimit_rad = radians(180.0);

// For joystick commands: the largest rate about each axis, and how long one command keeps the unit
// moving.
inline constexpr double kRateLimit_rad_s = 1.5;
inline constexpr double kRateLease_s = 0.3;

}  // namespace ols
