#include "central/ground/visibility.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "central/ground/above_ground.h"
#include "geometry/chi_square.h"
#include "geometry/wgs84.h"
#include "land/refraction.h"

namespace ols::fusion {

double visibility(const land::Surface& surface, const Eigen::Vector3d& camera_ecef,
                  const Eigen::Vector3d& target_ecef, const Eigen::Matrix3d& covariance_ecef) {
  constexpr double kBeside_m = 10.0;  // around camera and target, where the line meets the ground
  constexpr double kLeastStep_m = 5.0, kLeastSd_m = 0.1;
  constexpr double kNoBuilding_m = 100.0;  // no building is so high above the land
  const Eigen::Vector3d line = target_ecef - camera_ecef;
  const double range_m = line.norm();
  const Eigen::Vector3d along = line / range_m;
  const Eigen::Matrix3d R = R_ecef_enu(target_ecef);
  const double along_sd_m = std::sqrt(along.dot(covariance_ecef * along));
  // An error along the line moves the target on the line, not the line itself.
  const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - along * along.transpose();
  const Eigen::Vector3d up = across * R.col(2);
  const double up_variance_m2 = up.dot(covariance_ecef * up);
  const double end_m = range_m - 3.0 * along_sd_m - kBeside_m;
  double least = std::numeric_limits<double>::infinity();
  bool is_out = false;  // the line has left what covers the camera
  for (double at_m = kBeside_m; at_m < end_m;) {
    const Geodetic place = geodetic_from_ecef(camera_ecef + at_m * along);
    const auto top = surface.top(place.latitude_rad, place.longitude_rad);
    double clearance_m = std::numeric_limits<double>::infinity();
    if (top) {
      const double bent_m = land::refraction_slope(land::kRefraction, at_m) * (range_m - at_m);
      clearance_m = place.height_m + bent_m - top->height_m;
      const double share = at_m / range_m;
      const double variance_m2 = top->sd_m * top->sd_m + share * share * up_variance_m2;
      is_out |= clearance_m > 0.0;
      if (is_out)
        least = std::min(least, clearance_m / std::max(kLeastSd_m, std::sqrt(variance_m2)));
    }
    at_m += kLeastStep_m + 0.01 * at_m;
    if (top) at_m += std::max(0.0, clearance_m - kNoBuilding_m) / 2.0;
  }
  return normal_level(-least);
}

double plausibility(const land::Surface& surface, const Eigen::Vector3d& camera_ecef,
                    const Eigen::Vector3d& target_ecef, const Eigen::Matrix3d& covariance_ecef) {
  return std::min(probability_above(height_above_ground(surface, target_ecef, covariance_ecef)),
                  visibility(surface, camera_ecef, target_ecef, covariance_ecef));
}

}  // namespace ols::fusion
