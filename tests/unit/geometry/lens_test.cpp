#include "geometry/lens.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <array>
#include <limits>
#include <opencv2/calib3d.hpp>
#include <random>

#include "geometry/angles.h"
#include "geometry/direction.h"
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

TEST(Lens, SkewMovesXByY) {
  CameraIntrinsics camera = simple_camera();
  camera.skew = 10.0;
  EXPECT_TRUE(
      near(*project(camera, {0.0, 0.5, 1.0}), Eigen::Vector2d(645.0, 480.0 + 550.0), 1e-12));
}

TEST(Lens, ProjectsAsOpenCvDoes) {
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

TEST(Lens, NothingBehindTheCamera) {
  EXPECT_FALSE(project(simple_camera(), {0.1, 0.1, -1.0}));
  EXPECT_FALSE(project(simple_camera(), {0.1, 0.1, 0.0}));
  EXPECT_FALSE(project(simple_camera(), {0.1, 0.1, std::numeric_limits<double>::quiet_NaN()}));
}

TEST(Lens, UnprojectsWhatItProjected) {
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

struct WideLens {
  const char* name;
  LensModel model;
  std::array<double, 4> k;
  double field_rad;  // off the axis: where it ends
};

CameraIntrinsics camera_of(const WideLens& lens) {
  CameraIntrinsics camera = simple_camera();
  camera.fx_px = 300.0;
  camera.fy_px = 310.0;
  camera.skew = 2.0;
  camera.model = lens.model;
  camera.k1 = lens.k[0], camera.k2 = lens.k[1], camera.k3 = lens.k[2], camera.k4 = lens.k[3];
  return camera;
}

Eigen::Vector3d off_axis(double theta_rad, double around_rad) {
  return {std::sin(theta_rad) * std::cos(around_rad), std::sin(theta_rad) * std::sin(around_rad),
          std::cos(theta_rad)};
}

class Wide : public testing::TestWithParam<WideLens> {
 protected:
  const CameraIntrinsics camera_ = camera_of(GetParam());
};

INSTANTIATE_TEST_SUITE_P(
    Lenses, Wide,
    testing::Values(
        WideLens{"equidistant", LensModel::kFisheye, {}, kPi},
        WideLens{"measured", LensModel::kFisheye, {-0.032, 0.011, -0.0083, 0.0012}, kPi},
        // 2 sin(theta / 2)
        WideLens{"equisolid", LensModel::kFisheye, {-1.0 / 24, 1.0 / 1920, 0, 0}, kPi},
        // 1 - 0.6 theta^2 is zero at 1.29.
        WideLens{"folded", LensModel::kFisheye, {-0.2, 0, 0, 0}, 1.2909944},
        // 1 - 2.4 s + 1.25 s^2, s = theta^2, is negative from 0.6112 to 1.3088: it unfolds again.
        WideLens{"unfolded", LensModel::kFisheye, {-0.8, 0.25, 0, 0}, 0.7818491},
        WideLens{"polynomial", LensModel::kPolynomial, {0.02, -0.09, 0.011, 0.001}, kPi},
        // 1 - 0.5 theta
        WideLens{"parabola", LensModel::kPolynomial, {-0.25, 0, 0, 0}, 2.0}),
    [](const auto& lens) { return std::string(lens.param.name); });

TEST_P(Wide, ThereAndBackUpToWhereItEnds) {
  const double field = GetParam().field_rad;
  for (double theta = 0.0; theta < field - 1e-3; theta += 0.0173) {
    for (double around = 0.0; around < 6.2; around += 0.7) {
      const auto pixel = project(camera_, 7.0 * off_axis(theta, around));
      ASSERT_TRUE(pixel) << theta;
      const auto ray = unproject(camera_, *pixel);
      ASSERT_TRUE(ray) << theta;
      EXPECT_TRUE(near(*project(camera_, *ray), *pixel, 1e-9));
      EXPECT_LT(angle_between(*ray, off_axis(theta, around)), 1e-8);
    }
  }
  if (field < kPi) {
    EXPECT_FALSE(project(camera_, off_axis(field + 1e-6, 1.0)));
  }
  EXPECT_FALSE(project(camera_, {0.0, 0.0, -1.0}));
  const Eigen::Vector2d rim =
      *project(camera_, off_axis(field - 1e-3, 0.0)) - Eigen::Vector2d(camera_.cx_px, 480.0);
  EXPECT_FALSE(unproject(camera_, Eigen::Vector2d(camera_.cx_px, 480.0) + 1.01 * rim));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(project(camera_, {0.1, nan, 1.0}));
  EXPECT_FALSE(unproject(camera_, {0.1, nan}));
}

TEST_P(Wide, JacobiansAreTheDerivatives) {
  constexpr double kStep = 1e-6;
  for (const double share : {0.0, 1e-4, 0.3, 0.6, 0.9}) {
    const Eigen::Vector3d p = 3.0 * off_axis(share * GetParam().field_rad, 0.4);
    Eigen::Matrix<double, 2, 3> by_point;
    for (int axis = 0; axis < 3; ++axis) {
      const Eigen::Vector3d step = kStep * Eigen::Vector3d::Unit(axis);
      by_point.col(axis) =
          (*project(camera_, p + step) - *project(camera_, p - step)) / (2.0 * kStep);
    }
    EXPECT_TRUE(near(project_jacobian(camera_, p), by_point, 1e-5)) << share;
    Eigen::Matrix<double, 2, 4> by_k;
    for (int k = 0; k < 4; ++k) {
      const auto at = [&](double change) {
        CameraIntrinsics other = camera_;
        *std::array{&other.k1, &other.k2, &other.k3, &other.k4}[static_cast<std::size_t>(k)] +=
            change;
        return *project(other, p);
      };
      by_k.col(k) = (at(kStep) - at(-kStep)) / (2.0 * kStep);
    }
    EXPECT_TRUE(near(project_by_coefficients(camera_, p), by_k, 1e-4)) << share;
  }
}

TEST_P(Wide, FisheyeProjectsAsOpenCvDoes) {
  if (GetParam().model != LensModel::kFisheye) return;
  const CameraIntrinsics& c = camera_;
  const cv::Matx33d K(c.fx_px, 0.0, c.cx_px, 0.0, c.fy_px, c.cy_px, 0.0, 0.0, 1.0);
  std::vector<cv::Point3d> points;
  for (double theta = 0.01; theta < std::min(GetParam().field_rad, radians(89.0)); theta += 0.02) {
    const Eigen::Vector3d p = 5.0 * off_axis(theta, 40.0 * theta);
    points.emplace_back(p.x(), p.y(), p.z());
  }
  std::vector<cv::Point2d> pixels;
  cv::fisheye::projectPoints(points, pixels, cv::Vec3d(), cv::Vec3d(), K,
                             cv::Vec4d(c.k1, c.k2, c.k3, c.k4), c.skew / c.fx_px);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto pixel = project(c, {points[i].x, points[i].y, points[i].z});
    ASSERT_TRUE(pixel);
    EXPECT_TRUE(near(*pixel, Eigen::Vector2d(pixels[i].x, pixels[i].y), 1e-6));
  }
}

TEST(Lens, WideFieldOfView) {
  CameraIntrinsics camera = camera_of({"", LensModel::kFisheye, {-0.2, 0, 0, 0}, 0.0});
  camera.fx_px = 640.5;
  const double r = 0.8 * (1.0 - 0.2 * 0.64);
  camera.cx_px = 1279.5 - 640.5 * r;
  // The left half is wider than the lens.
  EXPECT_NEAR(field_of_view(camera).x(), 0.8 + 1.2909944, 1e-6);
}

TEST(Lens, NamesCoefficientsThatTheModelLacks) {
  CameraIntrinsics camera = distorted_camera();
  EXPECT_EQ(foreign_coefficients(camera), "");
  camera.k4 = 1.0;
  EXPECT_EQ(foreign_coefficients(camera), "k4");
  camera.model = LensModel::kFisheye;
  EXPECT_EQ(foreign_coefficients(camera), "p1, p2");
  EXPECT_EQ(foreign_coefficients(undistorted(camera)), "");
}

TEST(Lens, NothingBeyondTheFoldOfBarrelDistortion) {
  // r (1 - 0.3 r^2) is greatest at r = 1.054 and is back at the axis at r = 1.826.
  CameraIntrinsics camera = simple_camera();
  camera.k1 = -0.3;
  EXPECT_TRUE(project(camera, {1.0, 0.0, 1.0}));
  EXPECT_FALSE(project(camera, {1.1, 0.0, 1.0}));
  EXPECT_FALSE(project(camera, {1.8, 0.0, 1.0}));
  EXPECT_TRUE(unproject(camera, {640.0 + 700.0, 480.0}));
  EXPECT_FALSE(unproject(camera, {640.0 + 710.0, 480.0}));  // 0.703 is the greatest radius
}

TEST(Lens, NothingBeyondAFoldThatUnfoldsAgain) {
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

TEST(Lens, PincushionDoesNotFold) {
  CameraIntrinsics camera = simple_camera();
  camera.k1 = 0.2;
  camera.k2 = 0.05;
  camera.k3 = 0.01;
  const auto pixel = project(camera, {3.0, 0.0, 1.0});
  ASSERT_TRUE(pixel);
  EXPECT_TRUE(near(*unproject(camera, *pixel) * std::sqrt(10.0), Eigen::Vector3d(3, 0, 1), 1e-9));
}

TEST(Lens, NonFinitePixelsHaveNoRay) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(unproject(distorted_camera(), {nan, 0.0}));
  EXPECT_FALSE(unproject(distorted_camera(), {0.0, std::numeric_limits<double>::infinity()}));
}

TEST(Lens, JacobianIsTheDerivative) {
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

TEST(Lens, ProjectionMatrixAgreesWithProject) {
  const WorldCamera w;
  const auto P = projection_matrix(camera_matrix(w.intrinsics), w.R, w.C);
  const Eigen::Vector3d p_cam(3.0, -7.0, 40.0);
  const Eigen::Vector3d p_world = w.R.transpose() * p_cam + w.C;
  EXPECT_TRUE(near((P * p_world.homogeneous()).hnormalized(), *project(w.intrinsics, p_cam), 1e-6));
}

TEST(Lens, BackProjectionPointsToTheFront) {
  const WorldCamera w;
  const Eigen::Vector2d pixel(100.0, 900.0);
  const auto P = projection_matrix(camera_matrix(w.intrinsics), w.R, w.C);
  const Eigen::Vector3d expected = w.R.transpose() * *unproject(w.intrinsics, pixel);
  EXPECT_TRUE(near(back_project(P, pixel), expected, 1e-12));
  EXPECT_TRUE(near(back_project(-2.0 * P, pixel), expected, 1e-12));  // P is known up to scale
}

TEST(Lens, BackProjectionIsThePapersLine) {
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

TEST(Lens, FieldOfView) {
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
