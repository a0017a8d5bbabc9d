#include "calibration/sky.h"

#include <erfa.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "geometry/angles.h"
#include "geometry/direction.h"

namespace ols::calibration {
namespace {

using Eigen::Vector3d;

constexpr double kUnixEpoch_jd = 2440587.5;
constexpr double kDay_us = 86400e6;
constexpr double kEarthRate_rad_s = 7.292115e-5;

struct Sky {
  eraASTROM astrom{};
  double equation_of_origins = 0.0;
  double tdb1 = 0.0, tdb2 = 0.0;
};

// Without refraction, which is added below: its factor is a parameter.
Sky sky_at(std::int64_t utime_us, const Geodetic& place, const EarthRotation& earth) {
  const double utc2 = static_cast<double>(utime_us) / kDay_us;
  Sky sky;
  const int status = eraApco13(kUnixEpoch_jd, utc2, earth.ut1_minus_utc_s, place.longitude_rad,
                               place.latitude_rad, place.height_m, 0.0, 0.0, 0.0, 0.0, 0.0,
                               kWavelength_um, &sky.astrom, &sky.equation_of_origins);
  if (status < 0) throw std::invalid_argument("the time is outside of the calendar");
  double tai1 = 0.0, tai2 = 0.0;
  eraUtctai(kUnixEpoch_jd, utc2, &tai1, &tai2);
  eraTaitt(tai1, tai2, &sky.tdb1, &sky.tdb2);
  return sky;
}

SkyDirection appears(double ri, double di, Sky& sky, const Geodetic& place,
                     const AstronomicalRefraction& refraction) {
  double azimuth = 0.0, zenith = 0.0, hour_angle = 0.0, declination = 0.0, right_ascension = 0.0;
  eraAtioq(ri, di, &sky.astrom, &azimuth, &zenith, &hour_angle, &declination, &right_ascension);
  const Eigen::Matrix3d R = R_ecef_enu(place);
  const AzimuthElevation airless{azimuth, kPi / 2.0 - zenith};
  const double lift = refraction.lift_rad(zenith);
  SkyDirection result;
  result.elevation_rad = airless.elevation_rad + lift;
  const AzimuthElevation seen{azimuth, result.elevation_rad};
  result.ecef = R * enu_from_azimuth_elevation(seen);
  result.by_air = lift * R * tangent_basis(seen).col(1);
  // The sky turns westward about the Earth's axis.
  result.by_ut1 = -kEarthRate_rad_s * Vector3d::UnitZ().cross(result.ecef);
  return result;
}

SkyDirection star_in(Sky& sky, const Star& star, const Geodetic& place,
                     const AstronomicalRefraction& refraction) {
  double ri = 0.0, di = 0.0;
  // ERFA takes the motion of the right ascension itself.
  const double pm_ra = star.pm_ra_rad_yr / std::cos(star.dec_rad);
  eraAtciq(star.ra_rad, star.dec_rad, pm_ra, star.pm_dec_rad_yr, star.parallax_arcsec, 0.0,
           &sky.astrom, &ri, &di);
  return appears(ri, di, sky, place, refraction);
}

// [au] from the barycentre of the solar system.
Vector3d sun_barycentric(const Sky& sky) {
  double heliocentric[2][3], barycentric[2][3];
  eraEpv00(sky.tdb1, sky.tdb2, heliocentric, barycentric);
  return {barycentric[0][0] - heliocentric[0][0], barycentric[0][1] - heliocentric[0][1],
          barycentric[0][2] - heliocentric[0][2]};
}

// A body of the solar system: `barycentric(later)` is its place [au] so many days later. ERFA's
// place of the observer has that of the station in it, so that there is no parallax left to add.
template <class Barycentric>
SkyDirection body_direction(Sky& sky, const Geodetic& place, const Air& air,
                            const Barycentric& barycentric) {
  constexpr double kLight_d_per_au = 499.004784 / 86400.0;
  constexpr int kSteps = 4;  // of the light time
  const Vector3d observer(sky.astrom.eb[0], sky.astrom.eb[1], sky.astrom.eb[2]);
  Vector3d from = barycentric(0.0) - observer;
  for (int i = 0; i < kSteps; ++i) from = barycentric(-kLight_d_per_au * from.norm()) - observer;
  double towards[3] = {from.x(), from.y(), from.z()}, ra = 0.0, dec = 0.0, ri = 0.0, di = 0.0;
  eraC2s(towards, &ra, &dec);
  eraAtciqz(ra, dec, &sky.astrom, &ri, &di);
  return appears(ri, di, sky, place, AstronomicalRefraction(air));
}

// The zenith among the stars, without aberration.
Vector3d zenith_icrs(Sky& sky, const Geodetic& place) {
  // Of the Earth-fixed frame: its longitude is the local sidereal angle.
  const double angle = sky.astrom.eral;
  const double latitude = place.latitude_rad;
  double intermediate[3] = {std::cos(latitude) * std::cos(angle),
                            std::cos(latitude) * std::sin(angle), std::sin(latitude)};
  double icrs[3];
  eraTrxp(sky.astrom.bpn, intermediate, icrs);
  return {icrs[0], icrs[1], icrs[2]};
}

}  // namespace

SkyDirection star_direction(const Star& star, std::int64_t utime_us, const Geodetic& place,
                            const Air& air, const EarthRotation& earth) {
  Sky sky = sky_at(utime_us, place, earth);
  return star_in(sky, star, place, AstronomicalRefraction(air));
}

std::vector<std::pair<std::size_t, SkyDirection>> stars_between(
    const std::vector<Star>& stars, double least_deg, double most_deg, std::int64_t utime_us,
    const Geodetic& place, const Air& air, const EarthRotation& earth) {
  constexpr double kAberrationAndMotion_rad = 0.002;
  Sky sky = sky_at(utime_us, place, earth);
  const AstronomicalRefraction refraction(air);
  const Vector3d up = zenith_icrs(sky, place);
  const double least = std::sin(radians(least_deg) - kAberrationAndMotion_rad);
  const double most = std::sin(std::min(radians(most_deg) + kAberrationAndMotion_rad, kPi / 2.0));
  std::vector<std::pair<std::size_t, SkyDirection>> result;
  for (std::size_t i = 0; i < stars.size(); ++i) {
    const Star& star = stars[i];
    const Vector3d there(std::cos(star.ra_rad) * std::cos(star.dec_rad),
                         std::sin(star.ra_rad) * std::cos(star.dec_rad), std::sin(star.dec_rad));
    const double height = there.dot(up);
    if (height < least || height > most) continue;
    result.emplace_back(i, star_in(sky, star, place, refraction));
  }
  return result;
}

std::optional<Planet> planet_of(const std::string& name) {
  constexpr std::array<std::pair<const char*, Planet>, 4> kNames{{{"venus", Planet::kVenus},
                                                                  {"mars", Planet::kMars},
                                                                  {"jupiter", Planet::kJupiter},
                                                                  {"saturn", Planet::kSaturn}}};
  for (const auto& [known, planet] : kNames) {
    if (name == known) return planet;
  }
  return std::nullopt;
}

double planet_sd_rad(Planet planet) {
  // Half of the greatest error, as seen at the least distance.
  constexpr double kArcsec = kPi / 648000.0;
  switch (planet) {
    case Planet::kVenus:
      return 0.5 * 5.0 * 0.72 / 0.28 * kArcsec;
    case Planet::kMars:
      return 0.5 * 17.0 * 1.52 / 0.52 * kArcsec;
    case Planet::kJupiter:
      return 0.5 * 71.0 * 5.2 / 4.2 * kArcsec;
    case Planet::kSaturn:
      return 0.5 * 81.0 * 9.5 / 8.5 * kArcsec;
  }
  return 0.0;
}

SkyDirection planet_direction(Planet planet, std::int64_t utime_us, const Geodetic& place,
                              const Air& air, const EarthRotation& earth) {
  Sky sky = sky_at(utime_us, place, earth);
  return body_direction(sky, place, air, [&](double later_d) {
    double heliocentric[2][3];
    eraPlan94(sky.tdb1, sky.tdb2 + later_d, static_cast<int>(planet), heliocentric);
    const Vector3d there(heliocentric[0][0], heliocentric[0][1], heliocentric[0][2]);
    return Vector3d(sun_barycentric(sky) + there);
  });
}

SkyDirection sun_direction(std::int64_t utime_us, const Geodetic& place, const Air& air,
                           const EarthRotation& earth) {
  Sky sky = sky_at(utime_us, place, earth);
  // The sun moves by 10 km while its light travels: 0.01 arc seconds.
  return body_direction(sky, place, air, [&](double) { return sun_barycentric(sky); });
}

}  // namespace ols::calibration
