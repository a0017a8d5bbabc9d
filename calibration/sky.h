// Directions of stars and of the sun as they appear from a station, by the IAU's models (ERFA).
#pragma once

#include "calibration/observation.h"
#include "calibration/target.h"
#include "geometry/wgs84.h"

namespace ols::calibration {

struct Air {
  double pressure_hPa = 1013.25;  // at the station, not reduced to sea level
  double temperature_degC = 10.0;
  double humidity = 0.5;  // 0..1
};
// The standard atmosphere's at this height.
Air standard_air(double height_m);

// UT1 - UTC. Polar motion (below 0.6 arc seconds) is left out.
struct EarthRotation {
  double ut1_minus_utc_s = 0.0;
};

// ERFA's refraction is wrong by arc seconds below this.
inline constexpr double kLeastElevation_deg = 10.0;

// std::invalid_argument for an instant outside of ERFA's calendar.
SkyDirection star_direction(const Star& star, std::int64_t utime_us, const Geodetic& place,
                            const Air& air, const EarthRotation& earth);
SkyDirection sun_direction(std::int64_t utime_us, const Geodetic& place, const Air& air,
                           const EarthRotation& earth);

}  // namespace ols::calibration
