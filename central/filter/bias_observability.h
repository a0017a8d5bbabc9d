// Whether a station's biases may be estimated from a bearing. If the baseline is short for the
// range, the difference of two headings is not observable. A linear filter would estimate it
// nevertheless, with false certainty: from two stations side by side it would "learn" the
// difference, and with it a wrong range. Such biases are considered but not estimated
// (Schmidt-Kalman filter, 1966). Pure.
#pragma once

#include <Eigen/Core>

#include "central/filter/innovation.h"

namespace ols::fusion {

// Whether the product of bias and relative range error, which linearisation omits, is small against
// the noise. P_position: of the target [m^2]. P: of the whole state.
bool is_linear(const StationPart& part, const RayFrame& frame, double depth_m,
               const Eigen::Matrix3d& P_position, const FilterMatrix& P,
               const Eigen::Matrix2d& white);

// Whether the bearing's information on the station's states exceeds the linearisation error. along:
// the bearing's direction. G: the gain times the root of the innovation's covariance. off_share
// [1/m]: the part of the residual that is due to the prediction's error, divided by the depth.
bool shows_bias(const FilterMatrix2& G, const FilterMatrix& P, const StationPart& part,
                const Eigen::Vector3d& along, double off_share);

}  // namespace ols::fusion
