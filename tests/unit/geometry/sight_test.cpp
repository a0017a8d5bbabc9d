#include "geometry/sight.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <functional>
#include <utility>

#include "geometry/angles.h"
#include "tests/unit/geometry/near.h"

namespace ols {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using test::near;

// Heading east, level, without distortion.
StationGeometry plain_station() {
  StationGeometry station;
  station.position = {radians(49.2), radians(16.6), 300.0};
  station.chain.heading_rad = radians(90.0);
  return station;
}

// Everything that can be wrong with a station is.
StationGeometry crooked_station() {
  StationGeometry station = plain_station();
  station.chain.heading_rad = radians(211.0);
  station.chain.tilt_x_rad = 0.02;
  station.chain.tilt_y_rad = -0.03;
  station.chain.mount_z_rad = 0.015;
  station.chain.mount_x_rad = -0.04;
  station.chain.mount_y_rad = 0.01;
  station.chain.pan_sign = -1;
  station.chain.tilt_zero_rad = 0.05;
  station.camera.k1 = -0.2;
  station.camera.p1 = 1e-3;
  return station;
}

PixelSight at_pixel(const Vector2d& pixel, const PanTilt& angles = {}) {
  PixelSight measurement;
  measurement.pixel = pixel;
  measurement.angles = angles;
  return measurement;
}

const Vector2d kCentre(639.5, 479.5);

TEST(Sight, LooksAlongTheHeading) {
  const auto line = sight(plain_station(), at_pixel(kCentre));
  ASSERT_TRUE(line);
  EXPECT_NEAR(degrees(line->direction.azimuth_rad), 90.0, 1e-6);
  EXPECT_NEAR(degrees(line->direction.elevation_rad), 0.0, 1e-6);
  // Tripod 1.5 + 0.09, camera 0.06 above the axes and 0.05 ahead.
  const Vector3d centre_enu = LocalFrame(plain_station().position).to_enu(line->origin_ecef);
  EXPECT_TRUE(near(centre_enu, Vector3d(0.05, 0.0, 1.65), 1e-8));
}

TEST(Sight, AHundredPixelsRightAndDown) {
  const auto right = sight(plain_station(), at_pixel(kCentre + Vector2d(100.0, 0.0)));
  const auto down = sight(plain_station(), at_pixel(kCentre + Vector2d(0.0, 100.0)));
  const double angle_rad = std::atan(100.0 * 3.75e-6 / 50e-3);
  EXPECT_NEAR(right->direction.azimuth_rad, radians(90.0) + angle_rad, 1e-7);
  EXPECT_NEAR(down->direction.elevation_rad, -angle_rad, 1e-7);
}

TEST(Sight, HorizonIsTheOneAtTheCamera) {
  // A mast of 1 km to the north: the vertical at its end differs from GROUND's by 1 km over the
  // radius of curvature.
  StationGeometry station = plain_station();
  station.chain.heading_rad = 0.0;
  station.chain.ground_to_origin_m = {0.0, 1000.0, 0.0};
  const auto line = sight(station, at_pixel(kCentre));
  EXPECT_NEAR(line->direction.elevation_rad, 1000.0 / 6.372e6, 1e-7);
}

TEST(Sight, NothingForAPixelThatHasNoRay) {
  StationGeometry station = plain_station();
  station.camera.k1 = -300.0;  // folds within the image
  EXPECT_TRUE(sight(station, at_pixel(kCentre)));
  EXPECT_FALSE(sight(station, at_pixel({0.0, 0.0})));
}

TEST(Sight, PixelCovarianceByHand) {
  StationGeometry station = plain_station();
  PixelSight measurement = at_pixel(kCentre);
  measurement.covariance_px2 = Vector2d(4.0, 9.0).asDiagonal();
  measurement.covariance_px2(0, 1) = measurement.covariance_px2(1, 0) = 1.0;
  measurement.covariance_systematic_px2 = Vector2d(1.0, 16.0).asDiagonal();
  const auto line = sight(station, measurement);
  const double px_rad = 3.75e-6 / 50e-3;
  // Growing y is a falling elevation: the covariance changes its sign.
  Eigen::Matrix2d expected;
  expected << 4.0, -1.0, -1.0, 9.0;
  EXPECT_TRUE(near(line->covariance_white / (px_rad * px_rad), expected, 1e-6));
  const Eigen::Matrix2d systematic = Vector2d(1.0, 16.0).asDiagonal();
  EXPECT_TRUE(near(line->covariance_systematic / (px_rad * px_rad), systematic, 1e-6));
}

// The designation is told apart from the other systematic errors, of which it is a part.
TEST(Sight, TellsTheAimApart) {
  PixelSight measurement = at_pixel(kCentre);
  measurement.covariance_systematic_px2 = Vector2d(1.0, 16.0).asDiagonal();
  measurement.aim_sd_px = 2.0;
  const auto line = sight(plain_station(), measurement);
  const double px_rad = 3.75e-6 / 50e-3;
  EXPECT_NEAR(line->aim_sd_rad, 2.0 * px_rad, 1e-6 * px_rad);
  const Eigen::Matrix2d systematic = Vector2d(5.0, 20.0).asDiagonal();
  EXPECT_TRUE(near(line->covariance_systematic / (px_rad * px_rad), systematic, 1e-6));
}

// A direction at 70 degrees off the axis of an equidistant lens: f pixels a radian outwards, and
// f theta / sin(theta) around.
// Where a pixel is not as wide as it is high, an aim is the same across the line of sight.
TEST(Sight, AnAimIsRound) {
  StationGeometry station = plain_station();
  station.camera.fy_px = 2.0 * station.camera.fx_px;
  PixelSight measurement = at_pixel(kCentre);
  measurement.aim_sd_px = 2.0;
  const auto line = sight(station, measurement);
  const double variance = line->aim_sd_rad * line->aim_sd_rad;
  EXPECT_NEAR(variance, 0.5 * (4.0 + 1.0) * std::pow(3.75e-6 / 50e-3, 2), 1e-6 * variance);
  const Eigen::Matrix2d rest = line->covariance_systematic - variance * Eigen::Matrix2d::Identity();
  EXPECT_LT(rest.norm(), 1e-9 * variance);
}

TEST(Sight, PixelCovarianceFarOffTheAxisOfAWideLens) {
  StationGeometry station = plain_station();
  station.camera.model = LensModel::kFisheye;
  station.camera.fx_px = station.camera.fy_px = 400.0;
  const double theta = radians(70.0);
  PixelSight measurement = at_pixel(kCentre + Vector2d(400.0 * theta, 0.0));
  measurement.covariance_px2 = Vector2d(4.0, 9.0).asDiagonal();
  const auto line = sight(station, measurement);
  EXPECT_NEAR(degrees(line->direction.azimuth_rad), 160.0, 1e-6);
  const Vector2d expected(4.0, 9.0 * std::pow(std::sin(theta) / theta, 2));
  EXPECT_TRUE(
      near(line->covariance_white * 400.0 * 400.0, Eigen::Matrix2d(expected.asDiagonal()), 1e-5));
}

TEST(Sight, PanJitterIsSmallerAcrossWhenLookingUp) {
  PixelSight measurement = at_pixel(kCentre, {0.0, radians(60.0)});
  measurement.angles_covariance_rad2 = Vector2d(1e-6, 4e-6).asDiagonal();
  const auto line = sight(plain_station(), measurement);
  EXPECT_TRUE(
      near(line->covariance_white / 1e-6, Eigen::Matrix2d(Vector2d(0.25, 4.0).asDiagonal()), 1e-6));
  EXPECT_TRUE(near(line->covariance_systematic, Eigen::Matrix2d::Zero(), 0.0));
  std::swap(measurement.angles_covariance_rad2, measurement.angles_systematic_rad2);
  const auto lasting = sight(plain_station(), measurement);
  EXPECT_TRUE(near(lasting->covariance_systematic, line->covariance_white, 0.0));
  EXPECT_TRUE(near(lasting->covariance_white, Eigen::Matrix2d::Zero(), 0.0));
}

TEST(Sight, CalibrationErrorsByHand) {
  StationGeometry station = plain_station();
  const PixelSight up = at_pixel(kCentre, {0.0, radians(60.0)});
  const auto systematic = [&](const CalibrationSd& sd) {
    station.sd = sd;
    return sight(station, up)->covariance_systematic;
  };
  const auto diagonal = [](double cross_elevation, double elevation) {
    return Eigen::Matrix2d(Vector2d(cross_elevation, elevation).asDiagonal());
  };
  EXPECT_TRUE(near(systematic({.heading_rad = 1.0}), diagonal(0.25, 0.0), 1e-6));
  // About X (east): across by sin 60. About Y: all of it in elevation.
  EXPECT_TRUE(near(systematic({.tilt_rad = 1.0}), diagonal(0.75, 1.0), 1e-6));
  EXPECT_TRUE(near(systematic({.mount_rad = 2.0}), diagonal(4.0, 4.0), 1e-6));
  EXPECT_TRUE(near(systematic({.mount_roll_rad = 1.0}), diagonal(0.0, 0.0), 1e-6));
  station.sd = {.position_m = 0.7};
  EXPECT_TRUE(near(sight(station, up)->origin_sd_enu_m, Vector3d::Constant(0.7), 0.0));
}

// Shift of the line of sight on the tangent plane when one input is moved by +-h, over 2 h.
Vector2d derivative(const std::function<LineOfSight(double)>& line_at) {
  const double h = 1e-6;
  const LineOfSight here = line_at(0.0);
  const Eigen::Matrix<double, 3, 2> tangent =
      R_ecef_enu(here.origin_ecef) * tangent_basis(here.direction);
  return tangent.transpose() * (direction_ecef(line_at(h)) - direction_ecef(line_at(-h))) /
         (2.0 * h);
}

Eigen::Matrix2d square(const Vector2d& v) { return v * v.transpose(); }

TEST(Sight, WhiteCovarianceIsThatOfTheDerivatives) {
  const StationGeometry station = crooked_station();
  PixelSight m = at_pixel({150.0, 820.0}, {0.7, 0.6});
  const Vector2d by_x = derivative([&](double h) {
    return *sight(station, at_pixel(m.pixel + Vector2d(1e3 * h, 0.0), m.angles));
  });
  const Vector2d by_y = derivative([&](double h) {
    return *sight(station, at_pixel(m.pixel + Vector2d(0.0, 1e3 * h), m.angles));
  });
  const Vector2d by_pan = derivative([&](double h) {
    return *sight(station, at_pixel(m.pixel, {m.angles.pan_rad + h, m.angles.tilt_rad}));
  });
  const Vector2d by_tilt = derivative([&](double h) {
    return *sight(station, at_pixel(m.pixel, {m.angles.pan_rad, m.angles.tilt_rad + h}));
  });
  m.covariance_px2 << 1e6, 0.3e6, 0.3e6, 2e6;
  m.angles_covariance_rad2 << 1.0, -0.2, -0.2, 0.5;
  const Eigen::Matrix2d by_pixel = (Eigen::Matrix2d() << by_x, by_y).finished();
  const Eigen::Matrix2d by_angles = (Eigen::Matrix2d() << by_pan, by_tilt).finished();
  const Eigen::Matrix2d expected = by_pixel * (m.covariance_px2 / 1e6) * by_pixel.transpose() +
                                   by_angles * m.angles_covariance_rad2 * by_angles.transpose();
  EXPECT_TRUE(near(sight(station, m)->covariance_white, expected, 1e-6));
}

TEST(Sight, SystematicCovarianceIsThatOfTheDerivatives) {
  StationGeometry station = crooked_station();
  const PixelSight m = at_pixel({150.0, 820.0}, {0.7, 0.6});
  const auto by = [&](double ChainParameters::*parameter) {
    return derivative([&](double h) {
      StationGeometry moved = station;
      moved.chain.*parameter += h;
      return *sight(moved, m);
    });
  };
  const Eigen::Matrix2d heading = square(by(&ChainParameters::heading_rad));
  const Eigen::Matrix2d tilts =
      square(by(&ChainParameters::tilt_x_rad)) + square(by(&ChainParameters::tilt_y_rad));
  const Eigen::Matrix2d mount_all = square(by(&ChainParameters::mount_z_rad)) +
                                    square(by(&ChainParameters::mount_x_rad)) +
                                    square(by(&ChainParameters::mount_y_rad));
  const auto systematic = [&](const CalibrationSd& sd) {
    station.sd = sd;
    return sight(station, m)->covariance_systematic;
  };
  EXPECT_TRUE(near(systematic({.heading_rad = 1.0}), heading, 1e-6));
  EXPECT_TRUE(near(systematic({.tilt_rad = 1.0}), tilts, 1e-6));
  // The parameters turn one after the other, the uncertainty about the camera's own axes: the two
  // differ by the size of the mounting rotations.
  EXPECT_TRUE(near(systematic({.mount_rad = 1.0, .mount_roll_rad = 1.0}), mount_all, 5e-2));
}

TEST(View, IsTheWayBackOfSight) {
  const StationGeometry station = crooked_station();
  const PanTilt angles{-0.4, 0.3};
  const Vector2d pixel(1100.0, 77.0);
  const auto line = sight(station, at_pixel(pixel, angles));
  const Vector3d p_ecef = line->origin_ecef + 2500.0 * direction_ecef(*line);
  const auto seen = view(station, angles, p_ecef);
  ASSERT_TRUE(seen);
  EXPECT_TRUE(near(seen->pixel, pixel, 1e-7));
  EXPECT_NEAR(seen->distance_m, 2500.0, 1e-8);
}

TEST(View, NothingBehindTheCamera) {
  const StationGeometry station = plain_station();
  const LocalFrame ground(station.position);
  EXPECT_TRUE(view(station, {}, ground.to_ecef({100.0, 0.0, 0.0})));
  EXPECT_FALSE(view(station, {}, ground.to_ecef({-100.0, 0.0, 0.0})));
}

TEST(AimAt, PutsThePointOnThePixel) {
  const StationGeometry station = crooked_station();
  const LocalFrame ground(station.position);
  for (const Vector3d& p_enu :
       {Vector3d(300, 400, 100), Vector3d(-3, 5, 1), Vector3d(-20e3, 1e3, 3e3),
        Vector3d(30, 50, -300), Vector3d(1e5, -1e5, 1e4)}) {
    for (const Vector2d& pixel : {kCentre, Vector2d(3.0, 950.0)}) {
      const auto angles = aim_at(station, ground.to_ecef(p_enu), pixel);
      ASSERT_TRUE(angles) << p_enu.transpose();
      EXPECT_TRUE(near(view(station, *angles, ground.to_ecef(p_enu))->pixel, pixel, 1e-6));
    }
  }
}

TEST(AimAt, DefaultIsTheOpticalAxis) {
  const StationGeometry station = crooked_station();
  const Vector3d p_ecef = LocalFrame(station.position).to_ecef({-70.0, -90.0, 40.0});
  const auto angles = aim_at(station, p_ecef);
  ASSERT_TRUE(angles);
  const Vector3d axis_ecef = p_ecef - camera_centre_ecef(station, *angles);
  const LineOfSight axis{camera_centre_ecef(station, *angles), optical_axis(station, *angles)};
  EXPECT_LT(angle_between(direction_ecef(axis), axis_ecef), 1e-10);
}

TEST(AimAt, NothingOutOfReach) {
  const StationGeometry station = plain_station();
  const LocalFrame ground(station.position);
  const Vector3d overhead = ground.to_ecef({0.0, 0.0, 500.0});
  EXPECT_TRUE(aim_at(station, overhead));
  EXPECT_FALSE(aim_at(station, overhead, Vector2d(0.0, 479.5)));    // a ray aside never gets there
  EXPECT_FALSE(aim_at(station, ground.to_ecef({0.0, 0.0, 1.59})));  // in the PTU's axes
}

TEST(AimAlong, ReachesTheDirection) {
  const StationGeometry station = crooked_station();
  for (const double elevation_deg : {-40.0, 0.0, 30.0, 80.0}) {
    const AzimuthElevation wanted{radians(277.0), radians(elevation_deg)};
    const auto angles = aim_along(station, wanted);
    ASSERT_TRUE(angles);
    const AzimuthElevation axis = optical_axis(station, *angles);
    EXPECT_NEAR(axis.azimuth_rad, wanted.azimuth_rad, 1e-11);
    EXPECT_NEAR(axis.elevation_rad, wanted.elevation_rad, 1e-12);
  }
}

TEST(RotationHomography, MovesPixelsOfFarPoints) {
  StationGeometry station = crooked_station();
  station.camera.k1 = station.camera.p1 = 0.0;
  const PanTilt from{0.3, 0.2};
  const PanTilt to{0.32, 0.19};
  const Vector2d pixel(500.0, 600.0);
  const auto line = sight(station, at_pixel(pixel, from));
  const Vector3d far_ecef = line->origin_ecef + 1e9 * direction_ecef(*line);
  const Eigen::Matrix3d H = rotation_homography(station, from, to);
  EXPECT_TRUE(
      near((H * pixel.homogeneous()).hnormalized(), view(station, to, far_ecef)->pixel, 1e-4));
  EXPECT_TRUE(near(rotation_homography(station, to, to), Eigen::Matrix3d::Identity(), 1e-9));
}

}  // namespace
}  // namespace ols
