// The input and the result of the estimators: lines of sight at an epoch, and a position.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <string>
#include <vector>

#include "geometry/direction.h"

namespace ols::fusion {

// One station's bearing, aligned to the epoch (central/estimators/alignment.h).
struct Ray {
  std::string station;
  LineOfSight sight;
  // Angular rate of the direction on the tangent plane (cross-elevation, elevation).
  Eigen::Vector2d rate_rad_s = Eigen::Vector2d::Zero();
  Eigen::Matrix2d rate_covariance = Eigen::Matrix2d::Zero();  // [rad^2/s^2] white
  // White variance of one bearing before alignment, as the mean of both axes.
  double bearing_variance_rad2 = 0.0;
  double clock_sd_s = 0.0;  // 1-sigma of the time stamps, systematic
  double belief = 1.0;
  // Epoch minus time of the station's newest bearing (< 0: the bearing is newer)
  double age_s = 0.0;
};

// Direction and tangent plane (cross-elevation, elevation) of a line of sight, in ECEF components.
struct RayFrame {
  Eigen::Vector3d direction;
  Eigen::Matrix<double, 3, 2> tangent;
};
RayFrame ray_frame(const LineOfSight& sight);
// The same, for a caller that already has R_ecef_enu(sight.origin_ecef).
RayFrame ray_frame(const LineOfSight& sight, const Eigen::Matrix3d& R_ecef_enu);

// The covariance of a line of sight's stated systematic error, on its tangent plane [rad^2]:
// calibration, and the station's position error divided by range_m.
Eigen::Matrix2d stated_covariance(const LineOfSight& sight, double range_m);

// The covariance of a ray's systematic error: stated_covariance(), plus the effect of the clock
// error along the motion.
Eigen::Matrix2d systematic_covariance(const Ray& ray, double range_m);

// Why there is no position (kOk: there is one). The values are those of target_t.
enum class Solution {
  kOk,
  kTooFewRays,
  kParallelRays,  // also: stations at one place, or the range is too uncertain
  kBehindCamera,
  kTooFar,
  kNotConverged,
  kBearingOnly,  // only one station: a direction, no position
  kRaysMiss,     // rays do not intersect, or have intersected for too short a time
  kAmbiguous,    // two stations see objects that may be paired in several ways
};
const char* to_string(Solution solution);

// The fate of one ray.
struct RayUse {
  bool used = false;    // false if rejected as an outlier
  double weight = 0.0;  // 0..1, the robust weight
  // The squared normalised residual of both components together, and its expected value if all
  // covariances are right. Averaged over many epochs, these two values show whether a station's
  // covariances are right.
  double squared = 0.0;
  double expected = 0.0;
  // For each component (cross-elevation, elevation): the residual; the variance with which the ray
  // was weighted; and the share (0..1) of this variance that is expected to appear in the residual.
  // For a rejected ray, this share can exceed 1, because the error of the position adds to the
  // residual.
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

// A located target. All vectors and matrices are in ECEF components; NaN if undetermined.
struct Estimate {
  Solution solution = Solution::kTooFewRays;
  Eigen::Vector3d position_ecef = nan_vector();             // [m]
  Eigen::Matrix3d covariance_ecef = nan_matrix();           // [m^2] white and systematic together
  Eigen::Matrix3d covariance_white_ecef = nan_matrix();     // [m^2] the part that averaging reduces
  Eigen::Vector3d velocity_ecef = nan_vector();             // [m/s]
  Eigen::Matrix3d velocity_covariance_ecef = nan_matrix();  // [m^2/s^2]
  double crossing_angle_rad = std::numeric_limits<double>::quiet_NaN();  // 0..pi/2
  double residual = std::numeric_limits<double>::quiet_NaN();  // sqrt(chi^2 / degrees of freedom)
  std::vector<RayUse> rays{};                                  // in the order of the input rays
};

// The largest angle between the lines of any two of these directions, 0..pi/2; 0 for fewer than
// two.
double crossing_angle(const std::vector<Eigen::Vector3d>& directions);
// The same, for the used rays.
double crossing_angle(const std::vector<Ray>& rays, const std::vector<RayUse>& use);

}  // namespace ols::fusion
