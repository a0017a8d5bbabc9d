// Apparent directions of stars and of the sun from a station, by the IAU's models (ERFA).
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

// UT1 - UTC. Polar motion (below 0.6 arc seconds) is neglected.
struct EarthRotation {
  double ut1_minus_utc_s = 0.0;
};

// The max error of a planet's direction, each axis, when the planet is nearest to the Earth. It
// follows from the errors of the theory (Simon et al. 1994) over 1800-2050: at most 5, 17, 71 and
// 81 arc seconds in heliocentric longitude (Venus, Mars, Jupiter, Saturn). The sun's error is below
// 0.1.
enum class Planet { kVenus = 2, kMars = 4, kJupiter = 5, kSaturn = 6 };
std::optional<Planet> planet_of(const std::string& name);  // "venus"
double planet_sd_rad(Planet planet);

// Below this, ERFA's refraction is wrong by arc seconds.
inline constexpr double kLeastElevation_deg = 10.0;

// Throws std::invalid_argument for an instant outside ERFA's calendar.
SkyDirection star_direction(const Star& star, std::int64_t utime_us, const Geodetic& place,
                            const Air& air, const EarthRotation& earth);
// The same for all stars within about [least, most] degrees of elevation without refraction: index
// and direction.
std::vector<std::pair<std::size_t, SkyDirection>> stars_between(
    const std::vector<Star>& stars, double least_deg, double most_deg, std::int64_t utime_us,
    const Geodetic& place, const Air& air, const EarthRotation& earth);
// Includes light time, aberration and the parallax of the place.
SkyDirection planet_direction(Planet planet, std::int64_t utime_us, const Geodetic& place,
                              const Air& air, const EarthRotation& earth);
SkyDirection sun_direction(std::int64_t utime_us, const Geodetic& place, const Air& air,
                           const EarthRotation& earth);

}  // namespace ols::calibration
