// Apparent directions of stars, planets and the sun from a station, by the IAU's models (ERFA).
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

// The Earth's rotation: UT1 - UTC. Polar motion (below 0.6 arc seconds) is neglected.
struct EarthRotation {
  double ut1_minus_utc_s = 0.0;
};

// Planets are computed by the theory of Simon et al. (1994). In 1800-2050, its errors in
// heliocentric longitude are at most 5, 17, 71 and 81 arc seconds (Venus, Mars, Jupiter, Saturn).
// planet_sd_rad() is the 1-sigma of a planet's direction, each axis: half of this largest error, as
// seen when the planet is nearest to the Earth. The sun's error is below 0.1 arc seconds.
enum class Planet { kVenus = 2, kMars = 4, kJupiter = 5, kSaturn = 6 };
std::optional<Planet> planet_of(const std::string& name);  // for example "venus"
double planet_sd_rad(Planet planet);

// Below this elevation, ERFA's refraction is wrong by some arc seconds.
inline constexpr double kLeastElevation_deg = 10.0;

// The apparent direction of a star. Throws std::invalid_argument for an instant outside ERFA's
// calendar.
SkyDirection star_direction(const Star& star, std::int64_t utime_us, const Geodetic& place,
                            const Air& air, const EarthRotation& earth);
// The index and the apparent direction of each star whose elevation without refraction is between
// about least_deg and most_deg.
std::vector<std::pair<std::size_t, SkyDirection>> stars_between(
    const std::vector<Star>& stars, double least_deg, double most_deg, std::int64_t utime_us,
    const Geodetic& place, const Air& air, const EarthRotation& earth);
// The apparent direction of a planet. Includes light time, aberration and diurnal parallax (the
// effect of the station's distance from the Earth's centre).
SkyDirection planet_direction(Planet planet, std::int64_t utime_us, const Geodetic& place,
                              const Air& air, const EarthRotation& earth);
SkyDirection sun_direction(std::int64_t utime_us, const Geodetic& place, const Air& air,
                           const EarthRotation& earth);

}  // namespace ols::calibration
