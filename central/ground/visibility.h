// The probability that a station can see a position: that the land does not hide it. Pure.
#pragma once

#include <Eigen/Core>

#include "land/surface.h"

namespace ols::fusion {

// The probability that the land does not block the line from a camera to a target with this
// covariance [m^2, ECEF]. Obstacles within 3 sigmas of the target along the line are ignored,
// because the target may be in front of them. If the camera itself is below the surface (a roof, or
// a model that is too high there), the surface is ignored up to the point where the line first
// emerges from it. Returns 1 where the surface is unknown.
double visibility(const land::Surface& surface, const Eigen::Vector3d& camera_ecef,
                  const Eigen::Vector3d& target_ecef, const Eigen::Matrix3d& covariance_ecef);

// How plausible a target's position is. Returns the smaller of two probabilities: that the target
// is visible from the camera, and that the target is not below the ground.
double plausibility(const land::Surface& surface, const Eigen::Vector3d& camera_ecef,
                    const Eigen::Vector3d& target_ecef, const Eigen::Matrix3d& covariance_ecef);

// A plausibility below this value means that the target is below the ground, or hidden by the
// ground, by more than 3 sigmas.
inline constexpr double kImplausible = 0.00135;

}  // namespace ols::fusion
