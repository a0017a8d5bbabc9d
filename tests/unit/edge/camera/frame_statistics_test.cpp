#include "edge/camera/frame_statistics.h"

#include <gtest/gtest.h>

namespace ols::camera {
namespace {

TEST(FrameStatistics, RateAndLossesOfLate) {
  FrameStatistics statistics;
  EXPECT_DOUBLE_EQ(statistics.rate_hz(), 0.0);
  for (int i = 0; i < 200; ++i) statistics.add(0.1 * i, true);
  EXPECT_NEAR(statistics.rate_hz(), 10.0, 0.01);
  EXPECT_DOUBLE_EQ(statistics.incomplete_share(), 0.0);
  for (int i = 200; i < 400; ++i) statistics.add(0.1 * i, i % 2 == 0);
  EXPECT_NEAR(statistics.rate_hz(), 5.0, 0.2);
  EXPECT_NEAR(statistics.incomplete_share(), 0.5, 0.02);
}

}  // namespace
}  // namespace ols::camera
