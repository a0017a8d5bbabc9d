// A station that looks by itself: its whole process in simulated time, with the detector's thread.
#include <set>
#include <vector>

#include "geometry/angles.h"
#include "ols_msg/bearing_t.hpp"
#include "tests/unit/edge/process/station_in_simulated_time.h"

namespace ols::station {
namespace {

constexpr double kPeriod_s = 40.0;

class StationDetects : public test::StationInSimulatedTime {
 protected:
  StationDetects() : StationInSimulatedTime(test::passing_drone(kPeriod_s, {60.0, 30.0, 0.0})) {
    bus_.subscribe(station_channel(kBearingChannel, "alfa"), [this](const BusMessage& message) {
      ols_msg::bearing_t bearing{};
      if (decode_of_schema(message, bearing)) bearings_.push_back(bearing);
    });
  }
  // The direction of the target at a bearing's instant, and how far the bearing is off it.
  double off_rad(const ols_msg::bearing_t& bearing) const {
    const double time_s = 1e-6 * static_cast<double>(bearing.utime - kStart_us);
    const Eigen::Vector3d camera(bearing.camera_ecef_m);
    const LineOfSight sight{.origin_ecef = camera,
                            .direction = {bearing.azimuth_rad, bearing.elevation_rad}};
    return angle_between(direction_ecef(sight), world_.target(0, time_s).p_ecef - camera);
  }
  std::vector<ols_msg::bearing_t> bearings_;
};

TEST_F(StationDetects, WhatCrossesItsView) {
  ASSERT_TRUE(look_at_middle(0));
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
  EXPECT_EQ(test::counter_of(status_, "tracklets"), 1.0);
  EXPECT_GE(test::counter_of(status_, "detector_images"), static_cast<double>(bearings_.size()));
  EXPECT_EQ(status_.track_id, 0) << "it follows nothing";
}

}  // namespace
}  // namespace ols::station
