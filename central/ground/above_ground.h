// A position compared with the ground below it. Pure.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "land/surface.h"

namespace ols::fusion {

// The ground near a position, as a plane through the point below it.
struct LocalGround {
  double height_m = 0.0;                            // above the ellipsoid, below the position
  Eigen::Vector2d slope = Eigen::Vector2d::Zero();  // rise per metre east, per metre north
  double sd_m = 0.0;  // 1-sigma of the plane where the position may be: the model's error, and how
                      // far the ground is from a plane
};

// The plane spans the horizontal 1-sigma of the position, at least 5 m each way. Nothing where the
// surface is unknown. covariance_enu_m2: at the position.
std::optional<LocalGround> local_ground(const land::Surface& surface, const Eigen::Vector3d& p_ecef,
                                        const Eigen::Matrix3d& covariance_enu_m2);

struct HeightAboveGround {
  double height_m = 0.0;
  double sd_m = 0.0;  // 1-sigma, from position and ground
};

// Of a position with its covariance [m^2, ECEF]. Nothing where the surface is unknown.
std::optional<HeightAboveGround> height_above_ground(const land::Surface& surface,
                                                     const Eigen::Vector3d& p_ecef,
                                                     const Eigen::Matrix3d& covariance_ecef);

// The probability that the position is not below the ground; 1 where the surface is unknown.
double probability_above(const std::optional<HeightAboveGround>& height);

// The point of an object that a tracker follows is this high above the ground that the object
// stands on: the middle of a vehicle or a person.
inline constexpr double kMiddle_m = 1.0, kMiddleSd_m = 0.7;

// A position and its covariance [m, m^2, ECEF].
struct Position {
  Eigen::Vector3d p_ecef;
  Eigen::Matrix3d covariance_ecef;
};

// The position of an object that stands on the ground: one update with the height of the ground.
// Its error is the same at the next instant, so the result must not be fed back into a filter.
// Nothing where the surface is unknown, or more than 3 sigmas from the position.
std::optional<Position> put_on_ground(const land::Surface& surface, const Position& position);

}  // namespace ols::fusion
