// The height of a position above the ground. Pure.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "land/surface.h"

namespace ols::fusion {

// The ground near a position, as a plane through the point of the ground below the position.
struct LocalGround {
  double height_m = 0.0;  // of the ground below the position, above the ellipsoid
  Eigen::Vector2d slope = Eigen::Vector2d::Zero();  // rise per metre east, per metre north
  // 1-sigma of the plane's height near the position: the error of the land's model, and the
  // deviation of the ground from a plane, together.
  double sd_m = 0.0;
};

// The ground at a position with the covariance covariance_enu_m2. The plane is fitted over the
// horizontal 1-sigma of the position, and over at least 5 m in each direction. nullopt where the
// surface is unknown.
std::optional<LocalGround> local_ground(const land::Surface& surface, const Eigen::Vector3d& p_ecef,
                                        const Eigen::Matrix3d& covariance_enu_m2);

struct HeightAboveGround {
  double height_m = 0.0;
  double sd_m = 0.0;  // 1-sigma, from the errors of position and ground
};

// The height of a position with this covariance [m^2, ECEF]. nullopt where the surface is unknown.
std::optional<HeightAboveGround> height_above_ground(const land::Surface& surface,
                                                     const Eigen::Vector3d& p_ecef,
                                                     const Eigen::Matrix3d& covariance_ecef);

// The probability that a position is not below the ground; 1 where the surface is unknown.
double probability_above(const std::optional<HeightAboveGround>& height);

// The usual height of the middle of a vehicle or a person above the ground, and its 1-sigma. A
// tracker follows the middle of its object.
inline constexpr double kMiddle_m = 1.0, kMiddleSd_m = 0.7;

// A position and its covariance [m, m^2, ECEF].
struct Position {
  Eigen::Vector3d p_ecef;
  Eigen::Matrix3d covariance_ecef;
};

// The position of an object that stands on the ground: `position`, updated with the height of the
// ground. Do not feed the result back into a filter: the ground's error is the same at the next
// instant, but the filter would count it as independent. nullopt where the surface is unknown, or
// more than 3 sigmas away from the position.
std::optional<Position> put_on_ground(const land::Surface& surface, const Position& position);

}  // namespace ols::fusion
