// Directions of stars and of the sun as they appear from a station, by the IAU's models (ERFA).
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "calibration/observation.h"
#include "calibration/refraction.h"
#include "calibration/target.h"
#include "geometry/wgs84.h"

namespace ols::calibration {

// UT1 - UTC. Polar motion (below 0.6 arc seconds) is left out.
struct EarthRotation {
  double ut1_minus_utc_s = 0.0;
};

// How far a planet's direction may be off, of each axis: Simon et al. 1994, whose
// errors over 1800-2050 are at most 5, 17, 71 and 81 arc seconds in heliocentric longitude (Venus,
// Mars, Jupiter, Saturn), as they look from the Earth at its nearest; the sun's is below 0.1.
enum class Planet { kVenus = 2, kMars = 4, kJupiter = 5, kSaturn = 6 };
std::optional<Planet> planet_of(const std::string& name);  // "venus"
double planet_sd_rad(Planet planet);

// ERFA's refraction is wrong by arc seconds below this.
inline constexpr double kLeastElevation_deg = 10.0;

// std::invalid_argument for an instant outside of ERFA's calendar.
SkyDirection star_direction(const Star& star, std::int64_t utime_us, const Geodetic& place,
                            const Air& air, const EarthRotation& earth);
// The same of those that stand within [least, most] degrees of elevation without refraction, about:
// index and direction.
std::vector<std::pair<std::size_t, SkyDirection>> stars_between(
    const std::vector<Star>& stars, double least_deg, double most_deg, std::int64_t utime_us,
    const Geodetic& place, const Air& air, const EarthRotation& earth);
// With light time, aberration and the parallax of the place.
SkyDirection planet_direction(Planet planet, std::int64_t utime_us, const Geodetic& place,
                              const Air& air, const EarthRotation& earth);
SkyDirection sun_direction(std::int64_t utime_us, const Geodetic& place, const Air& air,
                           const EarthRotation& earth);

}  // namespace ols::calibration
