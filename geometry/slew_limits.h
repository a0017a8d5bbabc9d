// What a station accepts of a slew or of an operator's angles, and what the fusion and ols-ctl
// therefore ask for at most.
#pragma once

#include "geometry/angles.h"

namespace ols {

inline constexpr double kSlewRateLimit_rad_s = 1.5;  // about each axis
inline constexpr double kSlewLead_s = 1.0;           // between "now" and the effect, either way

// Pan and tilt as the PTU counts them, either way: what is beyond is a slip of the hand, which the
// unit would take by whole turns to somewhere else.
inline constexpr double kPointPanLimit_rad = radians(360.0);
inline constexpr double kPointTiltLimit_rad = radians(180.0);

// Pan and tilt rates by hand: about each axis, and for how long one command keeps the unit moving.
inline constexpr double kRateLimit_rad_s = 1.5;
inline constexpr double kRateLease_s = 0.3;

}  // namespace ols
