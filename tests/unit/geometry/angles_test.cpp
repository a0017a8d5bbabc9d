#include "geometry/angles.h"

#include <gtest/gtest.h>

namespace ols {
namespace {

TEST(Angles, ConvertAndWrap) {
  EXPECT_DOUBLE_EQ(radians(180.0), kPi);
  EXPECT_DOUBLE_EQ(degrees(kPi / 2.0), 90.0);
  EXPECT_NEAR(wrap_pi(radians(190.0)), radians(-170.0), 1e-14);
  EXPECT_NEAR(wrap_pi(radians(-541.0)), radians(179.0), 1e-14);
  EXPECT_NEAR(wrap_two_pi(radians(-1.0)), radians(359.0), 1e-14);
  EXPECT_NEAR(wrap_two_pi(radians(721.0)), radians(1.0), 1e-14);
}

TEST(Angles, WrapToTwoPiNeverGivesTwoPi) {
  EXPECT_EQ(wrap_two_pi(2.0 * kPi), 0.0);
  EXPECT_EQ(wrap_two_pi(-1e-20), 0.0);  // 2 pi - 1e-20 rounds to 2 pi
}

}  // namespace
}  // namespace ols
