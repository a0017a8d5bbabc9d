// Reference views of a station after a test has moved its tripod, unit or scenery.
#pragma once

#include <Eigen/Geometry>
#include <random>
#include <vector>

#include "edge/calibration/drift_finding.h"
#include "geometry/angles.h"

namespace ols::station::test {

inline constexpr double kArcsec = kPi / 648000.0;
inline constexpr double kStep = 46.2857 * kArcsec;  // 0.9 deg / 70
inline constexpr MotorSteps kSteps{kStep, kStep};
inline constexpr double kSd = 6.0 * kArcsec;

// The offsets of four views, 90 degrees apart and some degrees above the horizon, with noise. The
// station is turned by the rotation vector `turned` in ORIGIN, without linearisation.
inline std::vector<ViewOffset> views(const Eigen::Vector3d& turned, std::mt19937& random,
                                     double noise = 1.0) {
  std::normal_distribution<double> normal;
  std::vector<ViewOffset> all;
  for (int i = 0; i < 4; ++i) {
    const double pan = kPi * (-0.75 + 0.5 * i), tilt = 0.03 + 0.02 * i;
    const Eigen::Vector3d u(std::cos(pan) * std::cos(tilt), std::sin(pan) * std::cos(tilt),
                            std::sin(tilt));
    const double angle = turned.norm();
    const Eigen::Vector3d v = angle > 0.0 ? Eigen::AngleAxisd(angle, turned / angle) * u : u;
    const Eigen::Vector3d left(-std::sin(pan), std::cos(pan), 0.0);
    const Eigen::Vector3d up = u.cross(left);
    all.push_back({{pan, tilt},
                   left.dot(v) + noise * kSd * normal(random),
                   up.dot(v) + noise * kSd * normal(random),
                   kSd});
  }
  return all;
}

}  // namespace ols::station::test
