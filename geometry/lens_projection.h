// What a lens model has to know: how directions and the image plane, which K takes to pixels,
// belong together. lens.cpp alone chooses by the model.
#pragma once

#include "geometry/lens.h"

namespace ols {

struct LensProjection {
  // The names of the coefficients that the model has.
  const char* coefficients;
  // The point on the plane that images a point in camera coordinates; nullopt: none does.
  std::optional<Eigen::Vector2d> (*plane)(const CameraIntrinsics&, const Eigen::Vector3d& p_cam);
  // The unit direction that a point on the plane images, so well that the error of the pixel is
  // below `tolerance_px`; nullopt: none.
  std::optional<Eigen::Vector3d> (*ray)(const CameraIntrinsics&, const Eigen::Vector2d& xy,
                                        double tolerance_px);
  // The pixel's derivatives by the point, and by k1 to k4.
  Eigen::Matrix<double, 2, 3> (*by_point)(const CameraIntrinsics&, const Eigen::Vector3d& p_cam);
  Eigen::Matrix<double, 2, 4> (*by_coefficients)(const CameraIntrinsics&,
                                                 const Eigen::Vector3d& p_cam);
  // The angle off the axis at a radius on the plane, or the greatest one; of a pinhole without
  // distortion.
  double (*angle)(const CameraIntrinsics&, double radius);
};

const LensProjection& pinhole_projection();
const LensProjection& fisheye_projection();
const LensProjection& polynomial_projection();

// 2x2: pixels by the plane.
Eigen::Matrix2d pixel_by_plane(const CameraIntrinsics& camera);

}  // namespace ols
