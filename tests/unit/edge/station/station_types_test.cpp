#include "edge/station/station_types.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "geometry/angles.h"

namespace ols::station {
namespace {

// They are the names of counters, so that two of one name would be added up.
TEST(StationTypes, EachStateAndRefusalHasANameOfItsOwn) {
  std::set<std::string> states, refusals;
  const int last_state = static_cast<int>(StationState::kEmergency);
  for (int i = 0; i <= last_state; ++i) states.insert(to_string(static_cast<StationState>(i)));
  EXPECT_EQ(states.size(), static_cast<std::size_t>(last_state + 1));
  const int last_refusal = static_cast<int>(Refusal::kRearmNeedsAHand);
  for (int i = 0; i <= last_refusal; ++i) refusals.insert(to_string(static_cast<Refusal>(i)));
  EXPECT_EQ(refusals.size(), static_cast<std::size_t>(last_refusal + 1));
  EXPECT_FALSE(states.contains("unknown") || refusals.contains("unknown"));
}

TEST(StationTypes, ASlewsDirectionMovesOnFromItsInstant) {
  SlewCommand slew;
  slew.effect_s = 10.0;
  slew.direction = {radians(359.0), radians(5.0)};
  slew.azimuth_rate_rad_s = radians(4.0);
  slew.elevation_rate_rad_s = radians(-1.0);
  EXPECT_NEAR(degrees(direction_at(slew, 10.0).azimuth_rad), 359.0, 1e-9);
  EXPECT_NEAR(degrees(direction_at(slew, 10.5).azimuth_rad), 1.0, 1e-9) << "across north";
  EXPECT_NEAR(degrees(direction_at(slew, 10.5).elevation_rad), 4.5, 1e-9);
  EXPECT_NEAR(degrees(direction_at(slew, 9.0).azimuth_rad), 355.0, 1e-9) << "before it";
}

class PoseDiffersTest : public testing::Test {
 protected:
  PoseDiffersTest() {
    stated_.position = {radians(49.2), radians(16.6), 250.0};
    stated_.position_sd_enu_m = {1.0, 1.0, 2.0};
    stated_.tilt_sd_rad = 1e-3;
    now_ = stated_;
  }
  void raise(double height_m) { now_.position.height_m = stated_.position.height_m + height_m; }
  sensors::StationPose stated_, now_;
};

TEST_F(PoseDiffersTest, WithinTheStatedSigmasItIsTheSamePose) {
  EXPECT_FALSE(differs(stated_, now_));
  raise(1.9);
  now_.tilt_y_rad = -0.9e-3;
  EXPECT_FALSE(differs(stated_, now_));
}

TEST_F(PoseDiffersTest, BeyondAnyOfThemItIsAnother) {
  raise(2.1);
  EXPECT_TRUE(differs(stated_, now_));
  raise(0.0);
  now_.tilt_y_rad = -1.1e-3;
  EXPECT_TRUE(differs(stated_, now_));
  now_ = stated_;
  now_.tilt_source = sensors::PoseSource::kSensor;
  EXPECT_TRUE(differs(stated_, now_));
}

// A surveyed position may be stated without any deviation; arithmetic is no motion of the tripod.
TEST_F(PoseDiffersTest, NothingIsStatedBelowTheSensorsResolution) {
  stated_.position_sd_enu_m.setZero();
  stated_.tilt_sd_rad = 0.0;
  raise(0.5e-3);
  now_.tilt_x_rad = 0.5e-6;
  EXPECT_FALSE(differs(stated_, now_));
  raise(2e-3);
  EXPECT_TRUE(differs(stated_, now_));
}

}  // namespace
}  // namespace ols::station
