// Whether a bearing may teach of its station's biases. A base that is short for the range hides the
// difference of its headings, and a linear filter would find one in it and be sure: two stations
// side by side "learn" it, and a wrong range with it. Biases are then considered but not learnt
// (the Schmidt-Kalman filter, 1966). Pure.
#pragma once

#include <Eigen/Core>

#include "central/filter/innovation.h"

namespace ols::fusion {

// Bias times relative error of the range, which linearisation leaves out, is small against the
// noise. P_position: of the target [m^2]; P: of the whole state.
bool is_linear(const StationPart& part, const RayFrame& frame, double depth_m,
               const Eigen::Matrix3d& P_position, const FilterMatrix& P,
               const Eigen::Matrix2d& white);

// The bearing tells more of the station's states than linearisation makes up. along: the bearing's
// direction; G: the gain times the root of the innovation's covariance; off_share: of a residual
// that is the prediction's error, over the depth.
bool shows_bias(const FilterMatrix2& G, const FilterMatrix& P, const StationPart& part,
                const Eigen::Vector3d& along, double off_share);

}  // namespace ols::fusion
