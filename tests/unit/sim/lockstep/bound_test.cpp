#include <gtest/gtest.h>

#include <cmath>

#include "sim/lockstep/report.h"

namespace ols::sim {
namespace {

// Two stations, level, looking north-east and north-west at right angles; nothing but pixel noise.
Scenario two_stations() {
  Scenario s = parse_scenario(R"(
name = "two"
[site]
latitude_deg = 49.0
longitude_deg = 16.0
height_m = 300.0
[[station]]
id = "a"
position_enu_m = [-300.0, 0.0, 0.0]
heading_deg = 45.0
camera_address = "127.0.0.11"
[[station]]
id = "b"
position_enu_m = [300.0, 0.0, 0.0]
heading_deg = -45.0
camera_address = "127.0.0.12"
[[target]]
[target.trajectory]
kind = "line"
start_enu_m = [0.0, 300.0, 1.65]
)",
                              "two.toml", ".");
  Errors& e = s.errors;
  e.heading.on = e.tilt.on = e.mounting.on = e.position.on = e.distortion.on = e.clock.on = false;
  e.encoder.on = e.designation.on = false;
  return s;
}

TEST(Bound, OfTwoCrossingRaysIsThatComputedByHand) {
  const World world(two_stations(), 1);
  const MeasurementNoise noise{1.0, 1.0};
  const auto bound = position_bound_enu(world, 0.0, {0, 1}, noise);
  ASSERT_TRUE(bound);
  // Across each ray range * pixel / f; two rays at right angles give it on both horizontal axes,
  // and half of the variance on the vertical one. The camera sits 5 cm before the pan axis.
  const double range_m = 300.0 * std::sqrt(2.0) - 0.05;
  const double across_m2 = std::pow(range_m / world.scenario().camera.fx_px, 2);
  EXPECT_NEAR((*bound)(0, 0) / across_m2, 1.0, 0.01);
  EXPECT_NEAR((*bound)(1, 1) / across_m2, 1.0, 0.01);
  EXPECT_NEAR((*bound)(2, 2) / across_m2, 0.5, 0.01);
  EXPECT_NEAR((*bound)(0, 1) / across_m2, 0.0, 0.01);
}

TEST(Bound, SummaryTellsItsHorizontalPart) {
  Scenario s = two_stations();
  s.errors.designation.on = true;  // what averaging leaves
  const World world(s, 1);
  const MeasurementNoise noise{1.0, 1.0};
  const Eigen::Matrix3d bound = position_bound_enu(world, 0.0, {0, 1}, noise).value();
  Fix fix;
  fix.used = {0, 1};
  const BoundSummary summary = summarise_bound(world, {fix, fix}, noise, 1);
  EXPECT_NEAR(summary.crb_rmse_m, std::sqrt(bound.trace()), 1e-9);
  EXPECT_NEAR(summary.crb_horizontal_rmse_m, std::sqrt(bound(0, 0) + bound(1, 1)), 1e-9);
}

TEST(Bound, HeadingErrorActsAcrossTheRayOnly) {
  Scenario s = two_stations();
  s.errors.heading.on = true;
  s.errors.heading.sd_rad = 1e-3;
  const World world(s, 1);
  const auto bound = position_bound_enu(world, 0.0, {0, 1}, {0.01, 1.0});
  ASSERT_TRUE(bound);
  const double across_m = 300.0 * std::sqrt(2.0) * 1e-3;
  EXPECT_NEAR(std::sqrt((*bound)(0, 0)) / across_m, 1.0, 0.01);
  EXPECT_LT(std::sqrt((*bound)(2, 2)), 0.01 * across_m);
}

TEST(Bound, AClockErrorActsAlongTheMotion) {
  Scenario s = two_stations();
  auto line = std::make_shared<Line>();
  line->start_enu = {0.0, 300.0, 1.65};
  line->v_enu = {0.0, 0.0, 20.0};
  s.targets[0].trajectory = line;
  s.errors.clock.on = true;
  s.errors.clock.sd_s = 0.01;
  const World world(s, 1);
  const auto bound = position_bound_enu(world, 0.0, {0, 1}, {0.01, 1.0});
  ASSERT_TRUE(bound);
  EXPECT_NEAR(std::sqrt((*bound)(2, 2)), 0.2 / std::sqrt(2.0), 0.005);
}

TEST(Bound, OneStationDoesNotDetermineAPosition) {
  const World world(two_stations(), 1);
  EXPECT_FALSE(position_bound_enu(world, 0.0, {}, {}));
  const auto one = position_bound_enu(world, 0.0, {0}, {});
  EXPECT_TRUE(!one || one->trace() > 1e6);
}

}  // namespace
}  // namespace ols::sim
