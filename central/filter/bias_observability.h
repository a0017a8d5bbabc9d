// Decides whether a station's biases may be estimated from a bearing. If the distance between two
// stations is small compared with the range, the difference between their headings is not
// observable. A linear filter would nevertheless estimate this difference with false certainty, and
// derive a wrong range from it. Unobservable biases are considered but not estimated
// (Schmidt-Kalman filter, 1966). Pure.
#pragma once

#include <Eigen/Core>

#include "central/filter/innovation.h"

namespace ols::fusion {

// Whether the linearisation error is small compared with the noise: linearisation neglects the
// product of bias and relative range error. P_position: covariance of the target's position [m^2].
// P: covariance of the whole state.
bool is_linear(const StationPart& part, const RayFrame& frame, double depth_m,
               const Eigen::Matrix3d& P_position, const FilterMatrix& P,
               const Eigen::Matrix2d& white);

// Whether the bearing's information about the station's states exceeds the linearisation error.
// along: the bearing's direction. G: the gain times the root of the innovation's covariance.
// off_share [1/m]: the share (0..1) of the residual that comes from the error of the prediction,
// divided by the depth.
bool shows_bias(const FilterMatrix2& G, const FilterMatrix& P, const StationPart& part,
                const Eigen::Vector3d& along, double off_share);

}  // namespace ols::fusion
