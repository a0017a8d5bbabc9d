// Where a real unit (geometry/station_model.h) images a point or a direction, with the derivatives
// that an adjustment and the propagation of its covariance need.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "geometry/station_model.h"

namespace ols {

// Homogeneous, in GROUND (east-north-up): w = 1 and a position x [m], w = 0 and a direction x, or a
// direction x and its inverse distance w [1/m].
struct HomogeneousPoint {
  Eigen::Vector3d x = Eigen::Vector3d::UnitY();
  double w = 0.0;
};

struct PixelPrediction {
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  // By the parameters in the order of Parameter. By the position: of a target that stays where it
  // is; the turn of the horizon (0.03 arc seconds a metre) is left out.
  Eigen::Matrix<double, 2, kModelParameters> by_parameters;
  Eigen::Matrix2d by_shafts;  // [px/rad] pan, tilt
  Eigen::Matrix<double, 2, 3> by_x;
  Eigen::Vector2d by_w;
  Eigen::Vector3d ray_enu;  // x - w c: from the camera centre to the target, not of unit length
};

// Nothing when it is behind the camera or outside of the lens model.
std::optional<PixelPrediction> predict_pixel(const StationModel& model, const UnitReading& reading,
                                             const HomogeneousPoint& point);

// The direction of a pixel, and what the errors of the parameters make of it: its covariance on the
// tangent plane is J C J' of the parameters' C.
struct DirectionPrediction {
  AzimuthElevation direction;  // in the horizon at GROUND
  // 2 x parameters: (cross-elevation, elevation) by the parameters.
  Eigen::Matrix<double, 2, kModelParameters> by_parameters;
};

// Nothing when the pixel cannot be unprojected.
std::optional<DirectionPrediction> predict_direction(const StationModel& model,
                                                     const UnitReading& reading,
                                                     const Eigen::Vector2d& pixel);

}  // namespace ols
