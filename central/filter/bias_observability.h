// Decides whether a station's biases may be estimated from a bearing. If the baseline is short
// relative to the range, the difference between two headings is not observable. A linear filter
// would estimate it nevertheless, with false certainty: from two stations side by side it would
// "learn" a difference, and from it a wrong range. Such biases are considered but not estimated
// (Schmidt-Kalman filter, 1966). Pure.
#pragma once

#include <Eigen/Core>

#include "central/filter/innovation.h"

namespace ols::fusion {

// Whether the product of bias and relative range error, which linearisation omits, is small
// relative to the noise. P_position: covariance of the target's position [m^2]. P: covariance of
// the whole state.
bool is_linear(const StationPart& part, const RayFrame& frame, double depth_m,
               const Eigen::Matrix3d& P_position, const FilterMatrix& P,
               const Eigen::Matrix2d& white);

// Whether the bearing's information on the station's states exceeds the linearisation error. along:
// the bearing's direction. G: the gain times the root of the innovation's covariance. off_share
// [1/m]: the part of the residual that the prediction's error causes, divided by the depth.
bool shows_bias(const FilterMatrix2& G, const FilterMatrix& P, const StationPart& part,
                const Eigen::Vector3d& along, double off_share);

}  // namespace ols::fusion
