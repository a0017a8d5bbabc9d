// Caches the east-north-up axes at a station's position. A station seldom moves, and computing the
// axes takes as long as computing ten directions. Pure.
#pragma once

#include <Eigen/Core>

#include "central/measurement/ray.h"
#include "geometry/wgs84.h"

namespace ols::fusion {

class PlaceAxes {
 public:
  const Eigen::Matrix3d& R_ecef_enu(const Eigen::Vector3d& p_ecef) {
    if (p_ecef != place_ecef_) {
      place_ecef_ = p_ecef;
      R_ecef_enu_ = ols::R_ecef_enu(p_ecef);
    }
    return R_ecef_enu_;
  }

 private:
  // The position to which R_ecef_enu_ belongs; NaN before the first.
  Eigen::Vector3d place_ecef_ = nan_vector();
  Eigen::Matrix3d R_ecef_enu_ = nan_matrix();
};

}  // namespace ols::fusion
