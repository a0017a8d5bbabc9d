#include "calibration/sky.h"

#include <erfa.h>

#include <Eigen/Geometry>
#include <algorithm>
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
constexpr double kWavelength_um = 0.55;

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

// Refraction by A tan z + B tan^3 z of the apparent zenith distance.
double refraction_rad(double true_zenith_rad, const Air& air) {
  double A = 0.0, B = 0.0;
  eraRefco(air.pressure_hPa, air.temperature_degC, air.humidity, kWavelength_um, &A, &B);
  double lift = 0.0;
  constexpr double kSafe_rad = 1.5;  // the tangent is not used near the horizon
  for (int i = 0; i < 10; ++i) {
    const double t = std::tan(std::min(true_zenith_rad - lift, kSafe_rad));
    lift = A * t + B * t * t * t;
  }
  return lift;
}

SkyDirection appears(double ri, double di, Sky& sky, const Geodetic& place, const Air& air) {
  double azimuth = 0.0, zenith = 0.0, hour_angle = 0.0, declination = 0.0, right_ascension = 0.0;
  eraAtioq(ri, di, &sky.astrom, &azimuth, &zenith, &hour_angle, &declination, &right_ascension);
  const Eigen::Matrix3d R = R_ecef_enu(place);
  const AzimuthElevation airless{azimuth, kPi / 2.0 - zenith};
  const double lift = refraction_rad(zenith, air);
  SkyDirection result;
  result.elevation_rad = airless.elevation_rad + lift;
  const AzimuthElevation seen{azimuth, result.elevation_rad};
  result.ecef = R * enu_from_azimuth_elevation(seen);
  result.by_air = lift * R * tangent_basis(seen).col(1);
  // The sky turns westward about the Earth's axis.
  result.by_ut1 = -kEarthRate_rad_s * Vector3d::UnitZ().cross(result.ecef);
  return result;
}

}  // namespace

Air standard_air(double height_m) {
  // International standard atmosphere, troposphere.
  const double lapse_K_m = 6.5e-3, sea_level_K = 288.15;
  const double temperature_K = sea_level_K - lapse_K_m * height_m;
  Air air;
  air.pressure_hPa = 1013.25 * std::pow(temperature_K / sea_level_K, 5.2559);
  air.temperature_degC = temperature_K - 273.15;
  return air;
}

SkyDirection star_direction(const Star& star, std::int64_t utime_us, const Geodetic& place,
                            const Air& air, const EarthRotation& earth) {
  Sky sky = sky_at(utime_us, place, earth);
  double ri = 0.0, di = 0.0;
  // ERFA takes the motion of the right ascension itself.
  const double pm_ra = star.pm_ra_rad_yr / std::cos(star.dec_rad);
  eraAtciq(star.ra_rad, star.dec_rad, pm_ra, star.pm_dec_rad_yr, star.parallax_arcsec, 0.0,
           &sky.astrom, &ri, &di);
  return appears(ri, di, sky, place, air);
}

SkyDirection sun_direction(std::int64_t utime_us, const Geodetic& place, const Air& air,
                           const EarthRotation& earth) {
  Sky sky = sky_at(utime_us, place, earth);
  double heliocentric[2][3], barycentric[2][3];
  eraEpv00(sky.tdb1, sky.tdb2, heliocentric, barycentric);
  double towards_sun[3], ra = 0.0, dec = 0.0, ri = 0.0, di = 0.0;
  for (int i = 0; i < 3; ++i) towards_sun[i] = -heliocentric[0][i];
  eraC2s(towards_sun, &ra, &dec);
  // Of infinite distance: the parallax of 8 arc seconds is taken off below by the elevation.
  eraAtciqz(ra, dec, &sky.astrom, &ri, &di);
  SkyDirection sun = appears(ri, di, sky, place, air);
  constexpr double kParallax_rad = 8.794 * kPi / 648000.0;
  const double drop = kParallax_rad * std::cos(sun.elevation_rad);
  const Vector3d up = R_ecef_enu(place).col(2);
  const Vector3d along_up = (up - up.dot(sun.ecef) * sun.ecef).normalized();
  sun.ecef = (sun.ecef - drop * along_up).normalized();
  sun.elevation_rad -= drop;
  return sun;
}

}  // namespace ols::calibration
