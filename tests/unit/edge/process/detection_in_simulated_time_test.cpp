// A station that looks by itself: its whole process in simulated time, with the detector's thread.
#include <memory>
#include <set>
#include <vector>

#include "geometry/angles.h"
#include "ols_msg/bearing_t.hpp"
#include "tests/unit/edge/process/station_in_simulated_time.h"

namespace ols::station {
namespace {

using test::Command;
constexpr double kPeriod_s = 40.0;

// The drone passes the middle of the site twice in a period, 75 m above it.
sim::Scenario passing() {
  sim::Scenario s = sim::load_scenario(std::string(OLS_SCENARIOS) + "/faults.toml");
  s.detector_on = true;
  s.inclinometer.on = s.gnss.on = s.gpio.on = false;
  auto path = std::make_shared<sim::Lissajous>();
  path->centre_enu = {0.0, 0.0, 75.0};
  path->amplitude_m = {60.0, 30.0, 0.0};
  path->period_s.setConstant(kPeriod_s);
  s.targets.resize(1);
  s.targets.front().trajectory = path;
  return s;
}

class StationDetects : public test::StationInSimulatedTime {
 protected:
  StationDetects() : StationInSimulatedTime(passing()) {
    bus_.subscribe(station_channel(kBearingChannel, "alfa"), [this](const BusMessage& message) {
      ols_msg::bearing_t bearing{};
      if (decode_of_schema(message, bearing)) bearings_.push_back(bearing);
    });
  }
  double counter(const std::string& name) const {
    for (std::size_t i = 0; i < status_.counter_name.size(); ++i) {
      if (status_.counter_name[i] == name) return status_.counter_value[i];
    }
    return 0.0;
  }
  // The direction of the target at a bearing's instant, and how far the bearing is off it.
  double off_rad(const ols_msg::bearing_t& bearing) const {
    const double time_s = 1e-6 * static_cast<double>(bearing.utime - kStart_us);
    const Eigen::Vector3d camera(bearing.camera_ecef_m);
    const LineOfSight sight{.origin_ecef = camera,
                            .direction = {bearing.azimuth_rad, bearing.elevation_rad}};
    return angle_between(direction_ecef(sight), world_.target(0, time_s).p_ecef - camera);
  }
  static constexpr std::int64_t kStart_us = 1'700'000'000'000'000;
  std::vector<ols_msg::bearing_t> bearings_;
};

TEST_F(StationDetects, WhatCrossesItsView) {
  const auto angles = aim_at(world_.stations()[0].nominal, world_.site().to_ecef({0.0, 0.0, 75.0}));
  ASSERT_TRUE(angles);
  tilt_rad_ = angles->tilt_rad;
  ASSERT_TRUE(give(Command::COMMAND_POINT, angles->pan_rad));
  ASSERT_TRUE(time_.pass(kPeriod_s, [this] { return bearings_.size() > 15; }));
  std::set<std::int64_t> ids;
  for (const ols_msg::bearing_t& bearing : bearings_) {
    EXPECT_TRUE(bearing.detected);
    EXPECT_EQ(bearing.image_bearings, 1);
    EXPECT_LT(off_rad(bearing), radians(0.1));
    ids.insert(bearing.track_id);
  }
  EXPECT_EQ(ids.size(), 1U);
  time_.pass(1.0);
  EXPECT_EQ(counter("tracklets"), 1.0);
  EXPECT_GE(counter("detector_images"), static_cast<double>(bearings_.size()));
  EXPECT_EQ(status_.track_id, 0) << "it follows nothing";
}

}  // namespace
}  // namespace ols::station
