// Predicts at which pixel a real unit (geometry/station_model.h) images a point or a direction.
// Also computes the derivatives that an adjustment and the propagation of covariances need.
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
  // respect to the position assume that the target stays in place. They neglect that the station's
  // horizon turns if the station is moved (0.03 arc seconds per metre).
  Eigen::Matrix<double, 2, kModelParameters> by_parameters;
  Eigen::Matrix2d by_shafts;  // [px/rad] with respect to pan and tilt
  Eigen::Matrix<double, 2, 3> by_x;
  Eigen::Vector2d by_w;
  // x - w c, with the camera centre c: from c towards the target; not a unit vector.
  Eigen::Vector3d ray_enu;
};

// nullopt if the point is behind the camera or outside the lens model.
std::optional<PixelPrediction> predict_pixel(const StationModel& model, const UnitReading& reading,
                                             const HomogeneousPoint& point);

// The direction of a pixel, with its derivatives J with respect to the parameters. If C is the
// covariance of the parameters, J C J' is that of the direction, on the tangent plane.
struct DirectionPrediction {
  AzimuthElevation direction;  // relative to the horizon at GROUND
  // 2 x parameters: derivatives of (cross-elevation, elevation).
  Eigen::Matrix<double, 2, kModelParameters> by_parameters;
};

// nullopt if the pixel cannot be unprojected.
std::optional<DirectionPrediction> predict_direction(const StationModel& model,
                                                     const UnitReading& reading,
                                                     const Eigen::Vector2d& pixel);

}  // namespace ols
