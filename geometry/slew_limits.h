// What a station accepts of a slew, and what the fusion therefore asks for at most.
#pragma once

namespace ols {

inline constexpr double kSlewRateLimit_rad_s = 1.5;  // about each axis
inline constexpr double kSlewLead_s = 1.0;           // between "now" and the effect, either way

}  // namespace ols
