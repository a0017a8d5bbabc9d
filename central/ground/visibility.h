// Decides whether the land lets a station see a place. Pure.
#pragma once

#include <Eigen/Core>

#include "land/surface.h"

namespace ols::fusion {

// The probability that nothing on the land blocks the view from a camera to a target with this
// covariance [m^2, ECEF]. Obstacles within 3 sigmas of the target along the line do not count,
// because the target may be in front of them. Land that covers the camera (a roof, or a model that
// is too high there) does not count either, up to the point where the line first emerges from it.
// Returns 1 where the surface is unknown.
double visibility(const land::Surface& surface, const Eigen::Vector3d& camera_ecef,
                  const Eigen::Vector3d& target_ecef, const Eigen::Matrix3d& covariance_ecef);

// The probability that the target can be where it is: visible from the camera, and not below the
// ground. It is the smaller of the two probabilities.
double plausibility(const land::Surface& surface, const Eigen::Vector3d& camera_ecef,
                    const Eigen::Vector3d& target_ecef, const Eigen::Matrix3d& covariance_ecef);

// Below this plausibility, a position is below the ground, or hidden by it, by more than 3 sigmas.
inline constexpr double kImplausible = 0.00135;

}  // namespace ols::fusion
