// Readings of the sensors on a tripod at rest, for the tests of the pose, the position and the
// tilt.
#pragma once

#include <cmath>

#include "edge/sensors/pose_estimator.h"
#include "geometry/angles.h"

namespace ols::sensors::test {

using Eigen::Vector3d;

inline const Geodetic kGround{radians(49.2266), radians(16.5969), 310.0};
inline const Vector3d kAntenna_enu_m{0.1, -0.2, 1.9};
constexpr double kSd_m = 0.02;

inline Geodetic moved(const Geodetic& from, const Vector3d& by_enu_m) {
  return geodetic_from_ecef(LocalFrame(from).to_ecef(by_enu_m));
}

inline double distance_m(const Geodetic& a, const Geodetic& b) {
  return (ecef_from_geodetic(a) - ecef_from_geodetic(b)).norm();
}

inline GnssReading fix(double time_s, const Vector3d& error_enu_m = Vector3d::Zero(),
                       double sd_m = kSd_m) {
  GnssReading r;
  r.time_s = time_s;
  r.fix = GnssFix::kRtkFixed;
  r.antenna = moved(kGround, kAntenna_enu_m + error_enu_m);
  r.sd_enu_m.setConstant(sd_m);
  r.satellites_used = 14;
  return r;
}

inline GnssReading no_fix(double time_s) {
  GnssReading r;
  r.time_s = time_s;
  return r;
}

// A tilt whose last digits vary, as with a real sensor.
inline TiltReading tilt(double time_s, double x_deg = 0.12, double y_deg = -0.08) {
  const double flicker_deg = 0.0005 * std::sin(7.3 * time_s);
  return {time_s, radians(x_deg + flicker_deg), radians(y_deg)};
}

inline PoseEstimator::Config sensors_only() {
  PoseEstimator::Config c;
  c.ground_to_antenna_enu_m = kAntenna_enu_m;
  return c;
}

inline PoseEstimator::Config surveyed() {
  PoseEstimator::Config c = sensors_only();
  c.surveyed_position = kGround;
  c.surveyed_position_sd_m = 0.015;
  c.surveyed_tilt_rad = Eigen::Vector2d(radians(0.12), radians(-0.08));
  c.surveyed_tilt_sd_rad = 1e-4;
  return c;
}

// Adds the readings of both sensors between these times: ten tilts and one fix a second.
inline void feed(PoseEstimator& estimator, double from_s, double to_s,
                 const Vector3d& error_enu_m = Vector3d::Zero()) {
  for (int i = 0; from_s + 0.1 * i < to_s; ++i) {
    const double now_s = from_s + 0.1 * i;
    estimator.add(tilt(now_s));
    if (i % 10 == 0) estimator.add(fix(now_s, error_enu_m));
  }
}

}  // namespace ols::sensors::test
