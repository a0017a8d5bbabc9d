#include "sim/ptu/settings.h"

#include <gtest/gtest.h>

namespace ols::sim {
namespace {

TEST(PtuSettings, TheFactorysAreThoseOfTheUnit) {
  PtuUnitConfig config;
  config.pan_min_counts = -100;
  config.tilt_max_counts = 50;
  config.max_speed_counts_s = 1234;
  config.resolution_arcsec = 36.0;  // 0.01 degrees
  config.home_speed_rad_s = 0.1745329251994330;
  const PtuSettings settings = factory_settings(config);
  EXPECT_EQ(settings.axes[at(0)].user_least, -100);
  EXPECT_EQ(settings.axes[at(1)].user_greatest, 50);
  EXPECT_EQ(settings.axes[at(0)].upper_speed, 1234);
  EXPECT_EQ(settings.axes[at(1)].home_speed, 1000) << "10 degrees a second";
  EXPECT_TRUE(settings.echo);
  EXPECT_EQ(settings.feedback, PtuFeedback::kVerbose);
}

TEST(PtuSettings, AxesHaveTheirNames) {
  EXPECT_STREQ(ptu_axis_name(0), "Pan");
  EXPECT_STREQ(ptu_axis_name(1), "Tilt");
}

}  // namespace
}  // namespace ols::sim
