#include <gtest/gtest.h>

#include "geometry/angles.h"
#include "sim/world/trajectory.h"

namespace ols::sim {
namespace {

using Eigen::Vector3d;

void expect_velocity_is_derivative(const Trajectory& path, double from_s, double to_s) {
  constexpr double kStep = 1e-4;
  for (double t = from_s; t <= to_s; t += (to_s - from_s) / 37.0) {
    const Vector3d numerical =
        (path.at(t + kStep).p_enu - path.at(t - kStep).p_enu) / (2.0 * kStep);
    EXPECT_LT((numerical - path.at(t).v_enu).norm(), 1e-5) << "at " << t;
  }
}

TEST(Lissajous, VelocityIsTheDerivative) {
  Lissajous path;
  path.centre_enu = {10, -20, 75};
  path.amplitude_m = {140, 60, 30};
  path.period_s = {78, 39, 53};
  path.phase_rad = {0.3, 0, -1};
  expect_velocity_is_derivative(path, -5, 100);
}

TEST(Lissajous, IsACircleWithAQuarterBetweenTheAxes) {
  Lissajous path;
  path.amplitude_m = {50, 50, 0};
  path.period_s.setConstant(20);
  path.phase_rad = {kPi / 2, 0, 0};
  for (double t : {0.0, 3.0, 11.0}) {
    EXPECT_NEAR(path.at(t).p_enu.norm(), 50.0, 1e-9);
    EXPECT_NEAR(path.at(t).v_enu.norm(), 2 * kPi * 50 / 20, 1e-9);
  }
}

TEST(Line, MovesAtItsVelocity) {
  Line path;
  path.start_enu = {1, 2, 3};
  path.v_enu = {4, 5, 6};
  EXPECT_LT((path.at(2.0).p_enu - Vector3d(9, 12, 15)).norm(), 1e-12);
}

TEST(Spline, PassesThroughItsPointsSmoothly) {
  const std::vector<double> times = {0, 10, 15, 30};
  const std::vector<Vector3d> points = {{0, 0, 50}, {100, 0, 60}, {100, 60, 70}, {-20, 60, 40}};
  const Spline path(times, points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_LT((path.at(times[i]).p_enu - points[i]).norm(), 1e-9);
  }
  expect_velocity_is_derivative(path, 0.01, 29.99);
  for (double t : {10.0, 15.0}) {  // no corner in the velocity, nor in its slope
    const Vector3d before = path.at(t - 1e-6).v_enu, after = path.at(t + 1e-6).v_enu;
    EXPECT_LT((after - before).norm(), 1e-4);
  }
}

TEST(Spline, RestsBeforeAndAfter) {
  const Spline path({5, 10}, {{0, 0, 0}, {10, 0, 0}});
  EXPECT_EQ(path.at(0).p_enu.x(), 0.0);
  EXPECT_EQ(path.at(99).p_enu.x(), 10.0);
  EXPECT_EQ(path.at(99).v_enu.norm(), 0.0);
}

TEST(Spline, RefusesTooFewPointsAndTimesThatDoNotGrow) {
  EXPECT_THROW(Spline({0}, {{0, 0, 0}}), std::invalid_argument);
  EXPECT_THROW(Spline({0, 0}, {{0, 0, 0}, {1, 0, 0}}), std::invalid_argument);
}

TEST(Waypoints, AreFlownAtTheMeanSpeed) {
  const auto path = through_waypoints({{0, 0, 0}, {30, 40, 0}, {30, 100, 0}}, 10.0);
  EXPECT_LT((path->at(5.0).p_enu - Vector3d(30, 40, 0)).norm(), 1e-9);
  EXPECT_LT((path->at(11.0).p_enu - Vector3d(30, 100, 0)).norm(), 1e-9);
}

}  // namespace
}  // namespace ols::sim
