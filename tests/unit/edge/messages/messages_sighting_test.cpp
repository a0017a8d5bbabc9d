#include "edge/messages/messages_sighting.h"

#include <gtest/gtest.h>

namespace ols::station {
namespace {

TEST(MessagesSighting, HasWhatTheUnitAndTheTrackerSaid) {
  Sighting sighting;
  sighting.bearing.track_id = 4;
  sighting.bearing.belief = 0.9;
  sighting.bearing.pixel = {640.5, 480.25};
  sighting.bearing.covariance_px2 << 0.09, 0.01, 0.01, 0.16;
  sighting.bearing.designation_sd_px = 1.5;
  sighting.counts.pan = 100.25;
  sighting.counts.tilt_s = -30.0;
  sighting.counts.approach = {1, -1};
  sighting.counts.count = {5.61e-5, 5.62e-5};
  ols_msg::sighting_t message{};
  fill_sighting(sighting, message);
  EXPECT_EQ(message.track_id, 4);
  EXPECT_EQ(message.belief, 0.9);
  EXPECT_EQ(message.x_px, 640.5);
  EXPECT_EQ(message.y_px, 480.25);
  EXPECT_EQ(message.covariance_px2[1], 0.01);
  EXPECT_EQ(message.covariance_px2[2], 0.16);
  EXPECT_EQ(message.designation_sd_px, 1.5);
  EXPECT_EQ(message.pan_counts, 100.25);
  EXPECT_EQ(message.tilt_counts_s, -30.0);
  EXPECT_EQ(message.approach_pan, 1);
  EXPECT_EQ(message.approach_tilt, -1);
  EXPECT_EQ(message.tilt_count_rad, 5.62e-5);
}

}  // namespace
}  // namespace ols::station
