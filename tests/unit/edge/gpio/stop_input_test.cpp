#include "edge/gpio/stop_input.h"

#include <gtest/gtest.h>

namespace ols::gpio {
namespace {

TEST(StopInput, IsUnknownBeforeTheFirstLevel) {
  const StopInput input(0.05);
  EXPECT_EQ(input.pressed(100.0), std::nullopt);
  EXPECT_EQ(input.due_s(), std::nullopt);
}

TEST(StopInput, AFirstReleaseIsNoPressBeforeItIsStable) {
  StopInput input(0.05);
  input.level(false, 1.0);
  EXPECT_EQ(input.pressed(1.0), std::nullopt);
  EXPECT_EQ(input.pressed(1.049), std::nullopt);
  EXPECT_EQ(input.pressed(1.051), false);
}

TEST(StopInput, APressCountsAtOnce) {
  StopInput input(0.05);
  input.level(false, 1.0);
  input.level(true, 2.0);
  EXPECT_EQ(input.pressed(2.0), true);
  EXPECT_EQ(input.due_s(), std::nullopt);
}

TEST(StopInput, AReleaseCountsWhenItIsStable) {
  StopInput input(0.05);
  input.level(true, 1.0);
  input.level(false, 2.0);
  EXPECT_EQ(input.pressed(2.04), true);
  ASSERT_TRUE(input.due_s());
  EXPECT_DOUBLE_EQ(*input.due_s(), 2.05);
  EXPECT_EQ(input.pressed(2.051), false);
}

TEST(StopInput, BouncingStartsTheWaitAnew) {
  StopInput input(0.05);
  input.level(true, 1.0);
  input.level(false, 2.00);
  input.level(true, 2.01);
  input.level(false, 2.02);
  EXPECT_EQ(input.pressed(2.06), true);
  EXPECT_EQ(input.pressed(2.071), false);
}

TEST(StopInput, TheSameLevelAgainDoesNotStartTheWaitAnew) {
  StopInput input(0.05);
  input.level(true, 1.0);
  input.level(false, 2.00);
  input.level(false, 2.04);  // read again
  EXPECT_EQ(input.pressed(2.051), false);
}

TEST(StopInput, ALostLineIsPressedUntilAStableRelease) {
  StopInput input(0.05);
  input.level(false, 1.0);
  ASSERT_EQ(input.pressed(2.0), false);
  input.lost();
  EXPECT_EQ(input.pressed(2.0), true);
  EXPECT_EQ(input.pressed(1e6), true);
  input.level(false, 3.0);
  EXPECT_EQ(input.pressed(3.01), true);
  EXPECT_EQ(input.pressed(3.06), false);
}

}  // namespace
}  // namespace ols::gpio
