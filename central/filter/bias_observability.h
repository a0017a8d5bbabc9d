// Whether a station's biases may be estimated from a bearing. With a base that is short for the
// range, the difference of two headings is not observable, yet a linear filter would estimate it
// with false certainty: two stations side by side "learn" it, and a wrong range with it. Biases are
// then considered but not estimated (the Schmidt-Kalman filter, 1966). Pure.
#pragma once

#include <Eigen/Core>

#include "central/filter/innovation.h"

namespace ols::fusion {

// The product of bias and relative range error, which linearisation omits, is small against the
// noise. P_position: of the target [m^2]; P: of the whole state.
bool is_linear(const StationPart& part, const RayFrame& frame, double depth_m,
               const Eigen::Matrix3d& P_position, const FilterMatrix& P,
               const Eigen::Matrix2d& white);

// The bearing's information on the station's states exceeds the linearisation error. along: the
// bearing's direction; G: the gain times the root of the innovation's covariance; off_share: the
// share of a residual that is the prediction's error, over the depth.
bool shows_bias(const FilterMatrix2& G, const FilterMatrix& P, const StationPart& part,
                const Eigen::Vector3d& along, double off_share);

}  // namespace ols::fusion
