#include "edge/frames/sighting_desk.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ols::station {
namespace {

constexpr std::int64_t kWhole_us = 1'780'000'000'000'000;
constexpr double kStep_rad = 5.61e-5;

class SightingDeskTest : public testing::Test {
 protected:
  SightingDeskTest() {
    unit.set_limits({.count = {kStep_rad, kStep_rad}});
    for (int i = 0; i < 100; ++i) {
      mount::AngleSample sample;
      sample.time_s = 0.025 * i;
      sample.time_sd_s = 1e-4;
      sample.angles = {40.0 * i * kStep_rad, -10.0 * i * kStep_rad};
      unit.add(sample);
    }
  }
  // The station's clock is zero at a whole second less 0.5 s.
  std::vector<Sighting> bearing(double time_s, std::int64_t track_id = 1) {
    Bearing one;
    one.mid_exposure_s = time_s;
    one.track_id = track_id;
    one.pixel = {600.0, 400.0};
    return desk.take(one, kWhole_us - 500'000 + std::llround(1e6 * time_s), unit);
  }

  PointingModel unit{StationConfig{}};
  SightingDesk desk;
};

TEST_F(SightingDeskTest, TellsTheTwoExposuresAroundAWholeSecond) {
  std::vector<Sighting> told;
  for (double time_s = 0.07; time_s < 2.3; time_s += 0.1) {
    for (const Sighting& one : bearing(time_s)) told.push_back(one);
  }
  ASSERT_EQ(told.size(), 4U);  // of two seconds
  EXPECT_EQ(told[0].utime_us, kWhole_us - 30'000);
  EXPECT_EQ(told[1].utime_us, kWhole_us + 70'000);
  EXPECT_NEAR(told[0].counts.pan, 1600.0 * 0.47, 1e-6);
  EXPECT_EQ(told[0].counts.approach.pan, 1);
  EXPECT_EQ(told[0].counts.approach.tilt, -1);
  EXPECT_EQ(told[0].bearing.pixel.x(), 600.0);
}

TEST_F(SightingDeskTest, TellsNothingAcrossAGapOrAnotherTrack) {
  EXPECT_TRUE(bearing(0.2).empty());
  EXPECT_TRUE(bearing(0.6).empty());
  EXPECT_TRUE(bearing(1.45, 1).empty());
  EXPECT_TRUE(bearing(1.55, 2).empty());
}

TEST_F(SightingDeskTest, TellsNothingWhereTheCountsAreNotKnown) {
  EXPECT_TRUE(bearing(0.45).empty());
  unit.forget_angles();
  EXPECT_TRUE(bearing(0.55).empty());
}

}  // namespace
}  // namespace ols::station
