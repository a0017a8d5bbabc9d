// Whether the land lets a station see a place. Pure.
#pragma once

#include <Eigen/Core>

#include "land/surface.h"

namespace ols::fusion {

// The probability that nothing stands between a camera and a target with this covariance [m^2,
// ECEF]. What stands within 3 sigmas of the target along the line does not count: the target may be
// in front of it. Nor does what covers the camera, as a roof or a model that is too high there, up
// to where the line first comes out of it. 1 where the surface is unknown.
double visibility(const land::Surface& surface, const Eigen::Vector3d& camera_ecef,
                  const Eigen::Vector3d& target_ecef, const Eigen::Matrix3d& covariance_ecef);

// The same for whether it is possible at all: in front of what a line of sight ends at, and not
// below the ground. The smaller of the two probabilities.
double plausibility(const land::Surface& surface, const Eigen::Vector3d& camera_ecef,
                    const Eigen::Vector3d& target_ecef, const Eigen::Matrix3d& covariance_ecef);

// From this plausibility on, a position behind or below the ground is one by more than 3 sigmas.
inline constexpr double kImplausible = 0.00135;

}  // namespace ols::fusion
