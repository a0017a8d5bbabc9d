#include "edge/stop_latch.h"

#include <gtest/gtest.h>

namespace ols {
namespace {

TEST(StopLatch, APressBetweenTwoTurnsIsNotMissed) {
  StopLatch stop;
  EXPECT_FALSE(stop.take_press());
  stop.set(true);
  stop.set(false);
  EXPECT_FALSE(stop.pressed());
  EXPECT_TRUE(stop.take_press());
  EXPECT_FALSE(stop.take_press()) << "once";
}

TEST(StopLatch, HoldsItsLevel) {
  StopLatch stop;
  stop.set(true);
  EXPECT_TRUE(stop.take_press());
  EXPECT_TRUE(stop.pressed());
  EXPECT_FALSE(stop.take_press());
}

}  // namespace
}  // namespace ols
