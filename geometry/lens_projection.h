// The part of a lens that depends on its model: the mapping between directions and the image plane,
// which K maps to pixels. Only lens.cpp chooses by the model.
#pragma once

#include "geometry/lens.h"

namespace ols {

struct LensProjection {
  // The names of the coefficients that the model uses.
  const char* coefficients;
  // The image, on the plane, of a point in camera coordinates; nullopt if there is none.
  std::optional<Eigen::Vector2d> (*plane)(const CameraIntrinsics&, const Eigen::Vector3d& p_cam);
  // The unit direction whose image is this point on the plane, with an error below `tolerance_px`
  // in the pixel; nullopt if there is none.
  std::optional<Eigen::Vector3d> (*ray)(const CameraIntrinsics&, const Eigen::Vector2d& xy,
                                        double tolerance_px);
  // The pixel's derivatives with respect to the point, and with respect to k1 to k4.
  Eigen::Matrix<double, 2, 3> (*by_point)(const CameraIntrinsics&, const Eigen::Vector3d& p_cam);
  Eigen::Matrix<double, 2, 4> (*by_coefficients)(const CameraIntrinsics&,
                                                 const Eigen::Vector3d& p_cam);
  // The angle off the axis at a radius on the plane; beyond the model's end, the largest angle.
  // Distortion of a pinhole is ignored.
  double (*angle)(const CameraIntrinsics&, double radius);
};

const LensProjection& pinhole_projection();
const LensProjection& fisheye_projection();
const LensProjection& polynomial_projection();

// 2x2: the derivative of the pixel with respect to the point on the plane.
Eigen::Matrix2d pixel_by_plane(const CameraIntrinsics& camera);

}  // namespace ols
