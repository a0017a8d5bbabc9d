#include "calibration/procedure/sun_keep_out.h"

#include <gtest/gtest.h>

#include "geometry/angles.h"

namespace ols::calibration {
namespace {

// 2026-03-20 08:00 UTC at 49 N, 16 E: the sun stands in the south-east, some 30 degrees high.
constexpr std::int64_t kMorning_us = 1'773'993'600'000'000;

StationModel station() {
  StationModel model;
  model.geometry.position = {radians(49.2), radians(16.6), 300.0};
  model.geometry.chain.heading_rad = radians(130.0);
  return model;
}

class SunKeepOutTest : public testing::Test {
 protected:
  PanTilt beside(double right_deg) const {
    const AzimuthElevation sun = azimuth_elevation_from_enu(keep_out.sun_enu());
    return *aim_along(
        model.geometry,
        {sun.azimuth_rad + radians(right_deg) / std::cos(sun.elevation_rad), sun.elevation_rad});
  }
  std::int64_t now_us = kMorning_us;
  StationModel model = station();
  SunKeepOut keep_out{model, [this] { return now_us; }};
};

TEST_F(SunKeepOutTest, TheUnitKeepsAwayFromTheSunAndSaysWhy) {
  EXPECT_GT(keep_out.sun_enu().z(), std::sin(radians(15.0)));
  EXPECT_TRUE(keep_out.is_up());
  EXPECT_NE(keep_out.hindrance(beside(0.0)).find("the sun stands 0 degrees"), std::string::npos);
  EXPECT_FALSE(keep_out.hindrance(beside(7.5)).empty());
  EXPECT_FALSE(keep_out.hindrance(beside(-7.5)).empty());
  EXPECT_TRUE(keep_out.hindrance(beside(10.0)).empty());
  EXPECT_TRUE(keep_out.hindrance(beside(-10.0)).empty());
}

TEST_F(SunKeepOutTest, WhoMayHaveBeenTurnedKeepsFurtherAway) {
  EXPECT_TRUE(keep_out.hindrance(beside(12.0), radians(3.0)).empty());
  EXPECT_NE(keep_out.hindrance(beside(12.0), radians(5.0)).find("13 are kept"), std::string::npos);
}

TEST_F(SunKeepOutTest, ItMovesWithTheSunAndEndsAtNight) {
  const PanTilt at = beside(0.0);
  now_us += 2LL * 3600 * 1'000'000;
  EXPECT_TRUE(keep_out.hindrance(at).empty());
  EXPECT_FALSE(keep_out.hindrance(beside(0.0)).empty());
  now_us = kMorning_us + 12LL * 3600 * 1'000'000;
  EXPECT_LT(keep_out.sun_enu().z(), 0.0);
  EXPECT_FALSE(keep_out.is_up());
  EXPECT_TRUE(keep_out.hindrance(beside(0.0)).empty());
}

TEST_F(SunKeepOutTest, AFilterLiftsItUntilItIsTakenOff) {
  keep_out.lift();
  EXPECT_TRUE(keep_out.hindrance(beside(0.0)).empty());
  keep_out.restore();
  EXPECT_FALSE(keep_out.hindrance(beside(0.0)).empty());
}

}  // namespace
}  // namespace ols::calibration
