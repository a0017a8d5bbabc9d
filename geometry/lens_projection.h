// The part of a lens that differs between the lens models: the mapping between directions and
// points on the image plane. (K then maps these points to pixels.) Only lens.cpp uses this
// interface; lens.cpp also chooses the model.
#pragma once

#include "geometry/lens.h"

namespace ols {

struct LensProjection {
  // The names of the coefficients that the model uses.
  const char* coefficients;
  // The image of a point in camera coordinates, on the plane; nullopt if there is none.
  std::optional<Eigen::Vector2d> (*plane)(const CameraIntrinsics&, const Eigen::Vector3d& p_cam);
  // The unit direction whose image is this point on the plane; nullopt if there is none. The error
  // in the image is below `tolerance_px`.
  std::optional<Eigen::Vector3d> (*ray)(const CameraIntrinsics&, const Eigen::Vector2d& xy,
                                        double tolerance_px);
  // The pixel's derivatives with respect to the point, and with respect to k1 to k4.
  Eigen::Matrix<double, 2, 3> (*by_point)(const CameraIntrinsics&, const Eigen::Vector3d& p_cam);
  Eigen::Matrix<double, 2, 4> (*by_coefficients)(const CameraIntrinsics&,
                                                 const Eigen::Vector3d& p_cam);
  // The angle off the axis that corresponds to a radius on the plane. Beyond the radius at which
  // the model ends, returns the model's largest angle. Distortion of a pinhole is ignored.
  double (*angle)(const CameraIntrinsics&, double radius);
};

const LensProjection& pinhole_projection();
const LensProjection& fisheye_projection();
const LensProjection& polynomial_projection();

// 2x2: the derivative of the pixel with respect to the point on the plane.
Eigen::Matrix2d pixel_by_plane(const CameraIntrinsics& camera);

}  // namespace ols
