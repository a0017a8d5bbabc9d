// Predicts where a real unit (geometry/station_model.h) images a point or a direction, with the
// derivatives that an adjustment and the propagation of its covariance need.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "geometry/station_model.h"

namespace ols {

// A point in homogeneous coordinates, in GROUND (east-north-up). w = 1: x is a position [m]. w = 0:
// x is a direction. Other values of w: x is a direction, and w is the inverse distance [1/m].
struct HomogeneousPoint {
  Eigen::Vector3d x = Eigen::Vector3d::UnitY();
  double w = 0.0;
};

struct PixelPrediction {
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  // Derivatives with respect to the parameters, in the order of Parameter. The derivatives with
  // respect to the position hold for a target that stays in place. They neglect that the horizon
  // turns as the station moves (0.03 arc seconds per metre).
  Eigen::Matrix<double, 2, kModelParameters> by_parameters;
  Eigen::Matrix2d by_shafts;  // [px/rad] with respect to pan and tilt
  Eigen::Matrix<double, 2, 3> by_x;
  Eigen::Vector2d by_w;
  Eigen::Vector3d ray_enu;  // x - w c: from the camera centre to the target; not a unit vector
};

// nullopt when the point is behind the camera or outside the lens model.
std::optional<PixelPrediction> predict_pixel(const StationModel& model, const UnitReading& reading,
                                             const HomogeneousPoint& point);

// The direction of a pixel, with its derivatives J. The parameters' covariance C becomes J C J' on
// the tangent plane.
struct DirectionPrediction {
  AzimuthElevation direction;  // relative to the horizon at GROUND
  // 2 x parameters: derivatives of (cross-elevation, elevation).
  Eigen::Matrix<double, 2, kModelParameters> by_parameters;
};

// nullopt when the pixel cannot be unprojected.
std::optional<DirectionPrediction> predict_direction(const StationModel& model,
                                                     const UnitReading& reading,
                                                     const Eigen::Vector2d& pixel);

}  // namespace ols
