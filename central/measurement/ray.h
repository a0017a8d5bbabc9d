// A line of sight at an epoch, as the estimators take it, and what they answer.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <string>
#include <vector>

#include "geometry/direction.h"

namespace ols::fusion {

// One station's bearing, brought to the epoch (central/estimators/alignment.h).
struct Ray {
  std::string station;
  LineOfSight sight;
  // On the tangent plane (cross-elevation, elevation): how the direction moves.
  Eigen::Vector2d rate_rad_s = Eigen::Vector2d::Zero();
  Eigen::Matrix2d rate_covariance = Eigen::Matrix2d::Zero();  // [rad^2/s^2] white
  double bearing_variance_rad2 = 0.0;  // white, of one bearing before alignment, mean of two axes
  double clock_sd_s = 0.0;             // stays
  double belief = 1.0;
  double age_s = 0.0;  // epoch minus the newest bearing of the station (< 0: newer)
};

// Direction and tangent plane (cross-elevation, elevation) of a sight line, in ECEF components.
struct RayFrame {
  Eigen::Vector3d direction;
  Eigen::Matrix<double, 3, 2> tangent;
};
RayFrame ray_frame(const LineOfSight& sight);
// The same where the axes at its origin are known: R_ecef_enu(sight.origin_ecef).
RayFrame ray_frame(const LineOfSight& sight, const Eigen::Matrix3d& R_ecef_enu);

// What a sight line states of its systematic error, on its tangent plane [rad^2]: the calibration,
// and the station's position as seen from a target at this distance.
Eigen::Matrix2d stated_covariance(const LineOfSight& sight, double range_m);

// What stays from frame to frame of a ray's direction error: that, and the clock along the motion.
Eigen::Matrix2d systematic_covariance(const Ray& ray, double range_m);

// Why there is no position. The numbers are those of target_t.
enum class Solution {
  kOk,
  kTooFewRays,
  kParallelRays,  // also: stations at one place, range not determined by these covariances
  kBehindCamera,
  kTooFar,
  kNotConverged,
  kBearingOnly,  // one station alone: a line, no position
  kRaysMiss,  // rays of several stations that meet nowhere, or not for long enough to be one object
};
const char* to_string(Solution solution);

// What became of one ray.
struct RayUse {
  bool used = false;    // false: set aside as an outlier
  double weight = 0.0;  // 0..1, robust weight
  // For the judgement of stations over many epochs: the squared normalised residual of both
  // components, and its expectation if all covariances are true.
  double squared = 0.0;
  double expected = 0.0;
  // The same by component (cross-elevation, elevation): the residual, the variance that it was
  // weighted by, and the share of that variance that a residual shows (0..1; above 1 when set
  // aside, because the position's own error comes on top).
  Eigen::Vector2d residual_rad = Eigen::Vector2d::Zero();
  Eigen::Vector2d variance_rad2 = Eigen::Vector2d::Zero();
  Eigen::Vector2d redundancy = Eigen::Vector2d::Zero();
};

inline Eigen::Vector3d nan_vector() {
  return Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
}
inline Eigen::Matrix3d nan_matrix() {
  return Eigen::Matrix3d::Constant(std::numeric_limits<double>::quiet_NaN());
}

// A located target. Everything in ECEF components; NaN where there is nothing.
struct Estimate {
  Solution solution = Solution::kTooFewRays;
  Eigen::Vector3d position_ecef = nan_vector();             // [m]
  Eigen::Matrix3d covariance_ecef = nan_matrix();           // [m^2] white and systematic together
  Eigen::Matrix3d covariance_white_ecef = nan_matrix();     // [m^2] what averaging makes smaller
  Eigen::Vector3d velocity_ecef = nan_vector();             // [m/s]
  Eigen::Matrix3d velocity_covariance_ecef = nan_matrix();  // [m^2/s^2]
  double crossing_angle_rad = std::numeric_limits<double>::quiet_NaN();  // 0..pi/2
  double residual = std::numeric_limits<double>::quiet_NaN();  // sqrt(chi^2 / degrees of freedom)
  std::vector<RayUse> rays{};                                  // as the rays that were given
};

// Greatest angle between two of the rays that are used, folded to 0..pi/2; 0 for fewer than two.
double crossing_angle(const std::vector<Ray>& rays, const std::vector<RayUse>& use);

}  // namespace ols::fusion
