#include "sim/world/sun.h"

#include <erfa.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "sim/world/calibration_round.h"

namespace ols::sim {
namespace {

using Eigen::Vector3d;

constexpr double kUnixEpoch_jd = 2440587.5, kDay_us = 86400e6, kDay_s = 86400.0;

// Terrestrial time and UT1, as days after the epoch.
struct Times {
  double tt = 0.0, ut1 = 0.0;
};

Times times_at(std::int64_t utime_us) {
  const double utc = static_cast<double>(utime_us) / kDay_us;
  double tai_jd = 0.0, tai = 0.0, tt_jd = 0.0, tt = 0.0;
  if (eraUtctai(kUnixEpoch_jd, utc, &tai_jd, &tai) < 0) {
    throw std::invalid_argument("the time is outside of the calendar");
  }
  eraTaitt(tai_jd, tai, &tt_jd, &tt);
  return {tt_jd - kUnixEpoch_jd + tt, utc + kRoundUt1MinusUtc_s / kDay_s};
}

// Higher by the refraction, of which the apparent height is needed.
double lifted(double elevation_rad) {
  double A = 0.0, B = 0.0, lift = 0.0;
  eraRefco(kRoundPressure_hPa, kRoundTemperature_degC, 0.5, 0.55, &A, &B);
  constexpr double kLowest_rad = 0.03;  // below, the tangents grow without end
  for (int i = 0; i < 10; ++i) {
    const double t = 1.0 / std::tan(std::max(kLowest_rad, elevation_rad + lift));
    lift = A * t + B * t * t * t;
  }
  return elevation_rad + lift;
}

}  // namespace

SunTruth sun_over(const Geodetic& place, std::int64_t utime_us) {
  constexpr double kAu_m = 149597870700.0, kLight_au_day = 173.1446326742;
  constexpr double kRadius_m = 959.63 / 206264.806247 * kAu_m;
  const Times times = times_at(utime_us);
  double heliocentric[2][3], barycentric[2][3], to_terrestrial[3][3];
  eraEpv00(kUnixEpoch_jd, times.tt, heliocentric, barycentric);
  eraC2t06a(kUnixEpoch_jd, times.tt, kUnixEpoch_jd, times.ut1, 0.0, 0.0, to_terrestrial);
  Eigen::Matrix3d R;
  for (int i = 0; i < 9; ++i) R(i / 3, i % 3) = to_terrestrial[i / 3][i % 3];
  const Vector3d observer_au = R.transpose() * ecef_from_geodetic(place) / kAu_m;
  const Vector3d from = -Vector3d(heliocentric[0]) - observer_au;
  // Aberration by the Earth's motion.
  const Vector3d seen = from.normalized() + Vector3d(barycentric[1]) / kLight_au_day;
  const Vector3d enu = (R_ecef_enu(place).transpose() * R * seen).normalized();
  const double elevation_rad = lifted(std::asin(std::clamp(enu.z(), -1.0, 1.0)));
  const Eigen::Vector2d level = enu.head<2>().normalized() * std::cos(elevation_rad);
  return {Vector3d(level.x(), level.y(), std::sin(elevation_rad)),
          std::asin(kRadius_m / (from.norm() * kAu_m))};
}

void draw_filter(cv::Mat& gray) {
  constexpr double kThroughIt = 3.0;
  gray.setTo(kThroughIt);
}

void draw_sun(const Eigen::Vector2d& centre_px, double radius_px, bool filtered, cv::Mat& gray) {
  constexpr double kDisc = 170.0, kBurnt = 255.0, kGlare = 200.0, kGlareReach = 8.0;
  for (int y = 0; y < gray.rows; ++y) {
    auto* row = gray.ptr<std::uint8_t>(y);
    for (int x = 0; x < gray.cols; ++x) {
      const double distance = (Eigen::Vector2d(x, y) - centre_px).norm();
      const double covered = std::clamp(radius_px - distance + 0.5, 0.0, 1.0);
      const double glare = kGlare * std::exp(-distance / (kGlareReach * radius_px));
      const double around = filtered ? row[x] : std::min(kBurnt, row[x] + glare);
      const double value = (1.0 - covered) * around + covered * (filtered ? kDisc : kBurnt);
      row[x] = static_cast<std::uint8_t>(std::lround(value));
    }
  }
}

}  // namespace ols::sim
