#include "sim/world/boards.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <vector>

#include "geometry/angles.h"

namespace ols::sim {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kGray = 120.0;

CameraIntrinsics half_size_camera() {
  CameraIntrinsics camera;
  camera.width_px = 640;
  camera.height_px = 480;
  camera.fx_px = camera.fy_px = 6666.7;
  camera.cx_px = 330.0;
  camera.cy_px = 231.0;
  camera.k1 = -0.25;
  return camera;
}

ChainParameters mounted_askew() {
  ChainParameters chain;
  chain.heading_rad = radians(30.0);
  chain.tilt_x_rad = radians(0.1);
  chain.mount_z_rad = radians(0.25);
  chain.mount_x_rad = radians(-0.2);
  chain.mount_y_rad = radians(0.15);
  return chain;
}

struct View {
  CameraIntrinsics camera = half_size_camera();
  ChainParameters chain = mounted_askew();
  double trunnion_rad = radians(0.02);
  BoardsScenario scenario;

  Boards boards() const { return {scenario, chain, trunnion_rad}; }
  Eigen::Isometry3d pose(const PanTilt& at) const { return camera_on(chain, trunnion_rad, at); }
  cv::Mat picture(const Boards& boards, const PanTilt& at) const {
    cv::Mat gray(camera.height_px, camera.width_px, CV_8U, cv::Scalar(kGray));
    boards.draw(camera, pose(at), gray);
    return gray;
  }
};

// Centroid of what is darker than the background within so many pixels of a place.
Vector2d dark_centroid(const cv::Mat& gray, const Vector2d& about, int reach) {
  Vector3d sum = Vector3d::Zero();
  const int x0 = static_cast<int>(about.x()), y0 = static_cast<int>(about.y());
  for (int y = std::max(0, y0 - reach); y <= std::min(gray.rows - 1, y0 + reach); ++y) {
    for (int x = std::max(0, x0 - reach); x <= std::min(gray.cols - 1, x0 + reach); ++x) {
      sum += std::max(0.0, 210.0 - gray.at<std::uint8_t>(y, x)) * Vector3d(x, y, 1.0);
    }
  }
  return sum.head<2>() / sum.z();
}

// The middle of the only dark stretch of a column that is longer than two bars.
double zero_row(const cv::Mat& gray, int x, double bar_px) {
  constexpr double kHalf = 125.0;
  double entered = 0.0;
  for (int y = 1; y < gray.rows; ++y) {
    const double before = gray.at<std::uint8_t>(y - 1, x), now = gray.at<std::uint8_t>(y, x);
    if ((before < kHalf) == (now < kHalf)) continue;
    const double crossed = y - 1 + (kHalf - before) / (now - before);
    if (before < kHalf && crossed - entered > 2.0 * bar_px && entered > 0.0) {
      return 0.5 * (entered + crossed);
    }
    entered = now < kHalf ? crossed : 0.0;
  }
  ADD_FAILURE() << "no zero at column " << x;
  return 0.0;
}

TEST(Boards, TheCrossStandsInThePlaneSquareToTheTiltAxis) {
  for (const double off_m : {0.0, 0.05}) {
    View view;
    view.scenario.cross_error_m = off_m;
    view.scenario.blur_px_m = 160.0;
    Boards boards = view.boards();
    const PanTilt at{radians(12.0), radians(1.0)};
    boards.put_up({.cross = true}, view.camera, at);
    // Written out anew: heading, tilts, pan, trunnion, tilt; then so far ahead of the axes.
    using Eigen::AngleAxisd;
    const Eigen::Matrix3d base = (AngleAxisd(radians(60.0), Vector3d::UnitZ()) *
                                  AngleAxisd(view.chain.tilt_x_rad, Vector3d::UnitX()))
                                     .toRotationMatrix();
    const Eigen::Matrix3d head = (AngleAxisd(at.pan_rad, Vector3d::UnitZ()) *
                                  AngleAxisd(view.trunnion_rad, Vector3d::UnitX()) *
                                  AngleAxisd(-at.tilt_rad, Vector3d::UnitY()))
                                     .toRotationMatrix();
    const Vector3d axes = Vector3d(0.0, 0.0, 1.5) + base * Vector3d(0.0, 0.0, 0.09);
    const cv::Mat gray = view.picture(boards, at);
    const Vector2d about = dark_centroid(gray, {350.0, 239.5}, 60);
    const Vector2d found = dark_centroid(gray, about, 60);
    const Eigen::Isometry3d pose = view.pose(at);
    const Eigen::Matrix3d to_head = (base * head).transpose();
    const Vector3d from = to_head * (pose.translation() - axes);
    const Vector3d ray = to_head * (pose.linear() * unproject(view.camera, found).value());
    const Vector3d there = from + (view.scenario.cross_m - from.x()) / ray.x() * ray;
    EXPECT_NEAR(-there.y(), off_m, 5e-4);
  }
}

TEST(Boards, LevelLinesAreLevelButForTheirError) {
  for (const double error_rad : {0.0, radians(0.3)}) {
    View view;
    view.scenario.level_error_rad = error_rad;
    Boards boards = view.boards();
    const PanTilt at{radians(-20.0), radians(0.5)};
    boards.put_up({.level_line = true}, view.camera, at);
    const cv::Mat gray = view.picture(boards, at);
    // The middle line, far left and far right; as rays their elevations tell the slope.
    std::vector<double> elevation_rad;
    for (const int x : {200, 440}) {
      double sum = 0.0, rows = 0.0;
      for (int y = 215; y < 265; ++y) {
        const double dark = 210.0 - gray.at<std::uint8_t>(y, x);
        sum += dark, rows += dark * y;
      }
      const Vector3d ray =
          view.pose(at).linear() * unproject(view.camera, Vector2d(x, rows / sum)).value();
      elevation_rad.push_back(std::asin(ray.z()));
    }
    const double across_rad = 240.0 / view.camera.fx_px;
    EXPECT_NEAR((elevation_rad[0] - elevation_rad[1]) / across_rad, error_rad, 3e-4);
  }
}

TEST(Boards, TheRulersZerosAreAtOneHeight) {
  for (const double off_m : {0.0, 0.02}) {
    View view;
    view.scenario.ruler_error_m = off_m;
    Boards boards = view.boards();
    const PanTilt at{radians(5.0), radians(-0.1)};
    boards.put_up({.rulers = true}, view.camera, at);
    const cv::Mat gray = view.picture(boards, at);
    const auto height_m = [&](double right_m, double away_m) {
      const int x = static_cast<int>(319.5 + right_m / away_m * view.camera.fx_px);
      const Vector2d zero(x, zero_row(gray, x, 0.05 / away_m * view.camera.fx_px));
      const Eigen::Isometry3d pose = view.pose(at);
      const Vector3d ray = pose.linear() * unproject(view.camera, zero).value();
      const double axis_m = pose.translation().head<2>().norm();
      return pose.translation().z() + (away_m - axis_m) * ray.z() / ray.head<2>().norm();
    };
    EXPECT_NEAR(height_m(0.6, 40.0) - height_m(-0.3, 20.0), off_m, 2e-3);
  }
}

TEST(Boards, ABoardStaysWhereItWasPutUp) {
  View view;
  Boards boards = view.boards();
  const PanTilt first{0.0, 0.0}, second{radians(0.4), 0.0};
  boards.put_up({.cross = true}, view.camera, first);
  const Vector2d there = dark_centroid(view.picture(boards, first), {319.5, 239.5}, 80);
  boards.put_up({.cross = true}, view.camera, second);
  const double moved_px = radians(0.4) * view.camera.fx_px;
  const Vector2d seen =
      dark_centroid(view.picture(boards, second), there + Vector2d(moved_px, 0), 80);
  EXPECT_NEAR(seen.x() - there.x(), moved_px, 0.5);
  boards.put_up({}, view.camera, second);
  EXPECT_EQ(cv::countNonZero(view.picture(boards, second) != kGray), 0) << "it is taken away";
}

TEST(Boards, WhatIsBehindTheCameraIsNotDrawn) {
  View view;
  Boards boards = view.boards();
  boards.put_up({.level_line = true, .cross = true, .rulers = true}, view.camera, {});
  const PanTilt back{radians(180.0), 0.0};
  EXPECT_EQ(cv::countNonZero(view.picture(boards, back) != kGray), 0);
}

}  // namespace
}  // namespace ols::sim
