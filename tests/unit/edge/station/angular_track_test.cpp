#include "edge/station/angular_track.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/angles.h"

namespace ols::station {
namespace {

TEST(AngularTrack, KnowsNothingBeforeTheFirstUpdate) {
  AngularTrack track({});
  EXPECT_FALSE(track.state());
  EXPECT_FALSE(track.at(1.0));
}

TEST(AngularTrack, FindsTheRateOfASteadyTarget) {
  AngularTrack track({});
  for (int i = 0; i < 30; ++i) {
    const double t = i / 15.0;
    track.update(t, {0.1 + 0.17 * t, -0.05 * t}, 1e-4);
  }
  ASSERT_TRUE(track.state());
  EXPECT_NEAR(track.state()->rate.pan_rad, 0.17, 1e-3);
  EXPECT_NEAR(track.state()->rate.tilt_rad, -0.05, 1e-3);
  const auto ahead = track.at(2.5);
  ASSERT_TRUE(ahead);
  EXPECT_NEAR(ahead->pan_rad, 0.1 + 0.17 * 2.5, 1e-3);
}

TEST(AngularTrack, FollowsAManoeuvreWithinTheCentralThird) {
  AngularTrack track({});
  double worst = 0.0;
  for (int i = 0; i < 150; ++i) {
    const double t = i / 15.0;
    const double pan = 0.5 * std::sin(0.35 * t);  // up to 10 deg/s
    if (i > 15) worst = std::max(worst, std::abs(track.at(t)->pan_rad - pan));
    track.update(t, {pan, 0.0}, 1e-4);
  }
  EXPECT_LT(degrees(worst), 0.1);
}

TEST(AngularTrack, IgnoresTimeThatDoesNotGrow) {
  AngularTrack track({});
  track.update(1.0, {0.1, 0.0}, 1e-4);
  track.update(1.0, {0.9, 0.0}, 1e-4);
  track.update(0.5, {0.9, 0.0}, 1e-4);
  EXPECT_EQ(track.state()->angles.pan_rad, 0.1);
}

TEST(AngularTrack, AWrappedMeasurementIsTheSameDirection) {
  AngularTrack track({});
  track.update(0.0, {3.13, 0.0}, 1e-4);
  track.update(0.1, {-3.14, 0.0}, 1e-4);
  EXPECT_NEAR(track.state()->angles.pan_rad, 2.0 * kPi - 3.14, 1e-3);
}

}  // namespace
}  // namespace ols::station
