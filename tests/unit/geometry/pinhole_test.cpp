#include "geometry/pinhole.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <limits>
#include <opencv2/calib3d.hpp>
#include <random>

#include "geometry/angles.h"
#include "tests/unit/geometry/near.h"

namespace ols {
namespace {

using test::near;

CameraIntrinsics simple_camera() {
  CameraIntrinsics camera;
  camera.fx_px = 1000.0;
  camera.fy_px = 1100.0;
  camera.cx_px = 640.0;
  camera.cy_px = 480.0;
  return camera;
}

// A wide lens whose every term matters.
CameraIntrinsics distorted_camera() {
  CameraIntrinsics camera = simple_camera();
  camera.k1 = -0.28;
  camera.k2 = 0.07;
  camera.p1 = 1.2e-3;
  camera.p2 = -0.8e-3;
  camera.k3 = -0.005;
  return camera;
}

TEST(Pinhole, SkewMovesXByY) {
  CameraIntrinsics camera = simple_camera();
  camera.skew = 10.0;
  EXPECT_TRUE(
      near(*project(camera, {0.0, 0.5, 1.0}), Eigen::Vector2d(645.0, 480.0 + 550.0), 1e-12));
}

TEST(Pinhole, ProjectsAsOpenCvDoes) {
  const CameraIntrinsics c = distorted_camera();
  const cv::Matx33d K(c.fx_px, 0.0, c.cx_px, 0.0, c.fy_px, c.cy_px, 0.0, 0.0, 1.0);
  const std::vector<double> distortion{c.k1, c.k2, c.p1, c.p2, c.k3};
  std::mt19937 random(1);
  std::uniform_real_distribution<double> across(-0.6, 0.6);
  std::vector<cv::Point3d> points;
  for (int i = 0; i < 500; ++i)
    points.emplace_back(5.0 * across(random), 5.0 * across(random), 5.0);
  std::vector<cv::Point2d> pixels;
  cv::projectPoints(points, cv::Vec3d(), cv::Vec3d(), K, distortion, pixels);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto pixel = project(c, {points[i].x, points[i].y, points[i].z});
    ASSERT_TRUE(pixel);
    EXPECT_TRUE(near(*pixel, Eigen::Vector2d(pixels[i].x, pixels[i].y), 1e-9));
  }
}

TEST(Pinhole, NothingBehindTheCamera) {
  EXPECT_FALSE(project(simple_camera(), {0.1, 0.1, -1.0}));
  EXPECT_FALSE(project(simple_camera(), {0.1, 0.1, 0.0}));
  EXPECT_FALSE(project(simple_camera(), {0.1, 0.1, std::numeric_limits<double>::quiet_NaN()}));
}

TEST(Pinhole, UnprojectsWhatItProjected) {
  for (const CameraIntrinsics& camera : {CameraIntrinsics{}, distorted_camera()}) {
    for (double x = -0.5; x < camera.width_px; x += 53.0) {
      for (double y = -0.5; y < camera.height_px; y += 41.0) {
        const auto ray = unproject(camera, {x, y});
        ASSERT_TRUE(ray) << x << ' ' << y;
        EXPECT_NEAR(ray->norm(), 1.0, 1e-15);
        EXPECT_TRUE(near(*project(camera, 7.0 * *ray), Eigen::Vector2d(x, y), 2e-9));
      }
    }
  }
}

TEST(Pinhole, NothingBeyondTheFoldOfBarrelDistortion) {
  // r (1 - 0.3 r^2) is greatest at r = 1.054 and is back at the axis at r = 1.826.
  CameraIntrinsics camera = simple_camera();
  camera.k1 = -0.3;
  EXPECT_TRUE(project(camera, {1.0, 0.0, 1.0}));
  EXPECT_FALSE(project(camera, {1.1, 0.0, 1.0}));
  EXPECT_FALSE(project(camera, {1.8, 0.0, 1.0}));
  EXPECT_TRUE(unproject(camera, {640.0 + 700.0, 480.0}));
  EXPECT_FALSE(unproject(camera, {640.0 + 710.0, 480.0}));  // 0.703 is the greatest radius
}

TEST(Pinhole, NothingBeyondAFoldThatUnfoldsAgain) {
  // d/dr = 1 - 4.5 u + 5 u^2 is negative for 0.4 < u < 0.5, and positive again at u = 0.6.
  CameraIntrinsics camera = simple_camera();
  camera.k1 = -1.5;
  camera.k2 = 1.0;
  EXPECT_TRUE(project(camera, {std::sqrt(0.39), 0.0, 1.0}));
  EXPECT_FALSE(project(camera, {std::sqrt(0.45), 0.0, 1.0}));
  EXPECT_FALSE(project(camera, {std::sqrt(0.6), 0.0, 1.0}));
  // d/dr = 1 - 3 u + 2.78 u^3 dips to -0.2 at u = 0.6 and is 0.78 at u = 1.
  camera.k1 = -1.0;
  camera.k2 = 0.0;
  camera.k3 = 1.0 / (7.0 * 0.36);
  EXPECT_TRUE(project(camera, {std::sqrt(0.3), 0.0, 1.0}));
  EXPECT_FALSE(project(camera, {1.0, 0.0, 1.0}));
}

TEST(Pinhole, PincushionDoesNotFold) {
  CameraIntrinsics camera = simple_camera();
  camera.k1 = 0.2;
  camera.k2 = 0.05;
  camera.k3 = 0.01;
  const auto pixel = project(camera, {3.0, 0.0, 1.0});
  ASSERT_TRUE(pixel);
  EXPECT_TRUE(near(*unproject(camera, *pixel) * std::sqrt(10.0), Eigen::Vector3d(3, 0, 1), 1e-9));
}

TEST(Pinhole, NonFinitePixelsHaveNoRay) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(unproject(distorted_camera(), {nan, 0.0}));
  EXPECT_FALSE(unproject(distorted_camera(), {0.0, std::numeric_limits<double>::infinity()}));
}

TEST(Pinhole, JacobianIsTheDerivative) {
  CameraIntrinsics camera = distorted_camera();
  camera.skew = 3.0;
  const double h = 1e-6;
  for (const Eigen::Vector3d& p : {Eigen::Vector3d(0.3, -0.2, 1.0), Eigen::Vector3d(-2.0, 1.0, 4.0),
                                   Eigen::Vector3d(0.0, 0.0, 2.0)}) {
    Eigen::Matrix<double, 2, 3> numeric;
    for (int axis = 0; axis < 3; ++axis) {
      const Eigen::Vector3d step = h * Eigen::Vector3d::Unit(axis);
      numeric.col(axis) = (*project(camera, p + step) - *project(camera, p - step)) / (2.0 * h);
    }
    EXPECT_TRUE(near(project_jacobian(camera, p), numeric, 1e-5));
  }
}

// A camera 6400 km from the origin of the world, turned every way.
struct WorldCamera {
  CameraIntrinsics intrinsics = simple_camera();
  Eigen::Matrix3d R = (Eigen::AngleAxisd(0.4, Eigen::Vector3d::UnitX()) *
                       Eigen::AngleAxisd(2.0, Eigen::Vector3d::UnitZ()))
                          .toRotationMatrix();
  Eigen::Vector3d C{4e6, 1.2e6, 4.8e6};
};

TEST(Pinhole, ProjectionMatrixAgreesWithProject) {
  const WorldCamera w;
  const auto P = projection_matrix(camera_matrix(w.intrinsics), w.R, w.C);
  const Eigen::Vector3d p_cam(3.0, -7.0, 40.0);
  const Eigen::Vector3d p_world = w.R.transpose() * p_cam + w.C;
  EXPECT_TRUE(near((P * p_world.homogeneous()).hnormalized(), *project(w.intrinsics, p_cam), 1e-6));
}

TEST(Pinhole, BackProjectionPointsToTheFront) {
  const WorldCamera w;
  const Eigen::Vector2d pixel(100.0, 900.0);
  const auto P = projection_matrix(camera_matrix(w.intrinsics), w.R, w.C);
  const Eigen::Vector3d expected = w.R.transpose() * *unproject(w.intrinsics, pixel);
  EXPECT_TRUE(near(back_project(P, pixel), expected, 1e-12));
  EXPECT_TRUE(near(back_project(-2.0 * P, pixel), expected, 1e-12));  // P is known up to scale
}

TEST(Pinhole, BackProjectionIsThePapersLine) {
  // X(lambda) = P+ x + lambda C, with P+ = P^T (P P^T)^-1: near the origin its arithmetic is good.
  WorldCamera w;
  w.C = {3.0, -2.0, 5.0};
  const Eigen::Vector2d pixel(1000.0, 200.0);
  const auto P = projection_matrix(camera_matrix(w.intrinsics), w.R, w.C);
  const Eigen::Vector4d on_line =
      P.transpose() * (P * P.transpose()).inverse() * pixel.homogeneous();
  const Eigen::Vector3d along = on_line.hnormalized() - w.C;
  EXPECT_NEAR(along.normalized().cross(back_project(P, pixel)).norm(), 0.0, 1e-9);
}

TEST(Pinhole, FieldOfView) {
  CameraIntrinsics camera;
  camera.width_px = 2000;
  camera.height_px = 1000;
  camera.fx_px = 1000.0;
  camera.fy_px = 1000.0;
  camera.cx_px = 999.5;
  camera.cy_px = -0.5;  // the principal point on the upper edge
  EXPECT_NEAR(field_of_view(camera).x(), kPi / 2.0, 1e-12);
  EXPECT_NEAR(field_of_view(camera).y(), kPi / 4.0, 1e-12);
}

}  // namespace
}  // namespace ols
