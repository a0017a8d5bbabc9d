#include "edge/command/stop_latch.h"

#include <gtest/gtest.h>

namespace ols::station {
namespace {

TEST(StopLatch, APressBetweenTwoTurnsIsNotMissed) {
  StopLatch stop(true);
  EXPECT_FALSE(stop.take_press());
  stop.set(true);
  stop.set(false);
  EXPECT_FALSE(stop.pressed());
  EXPECT_TRUE(stop.take_press());
  EXPECT_FALSE(stop.take_press()) << "once";
}

TEST(StopLatch, IsUnknownUntilTheFirstLevelWhereThereIsAStop) {
  StopLatch stop(true);
  EXPECT_FALSE(stop.known());
  stop.set(false);
  EXPECT_TRUE(stop.known());
  EXPECT_FALSE(stop.take_press());
  EXPECT_TRUE(StopLatch(false).known());
}

TEST(StopLatch, ARearmCountsOnceAndNotAfterAnotherPress) {
  StopLatch stop(true);
  stop.set(false);
  EXPECT_FALSE(stop.take_rearm());
  stop.rearm();
  EXPECT_TRUE(stop.take_rearm());
  EXPECT_FALSE(stop.take_rearm());
  stop.rearm();
  stop.set(true);
  stop.set(false);
  EXPECT_FALSE(stop.take_rearm()) << "it was held before the press";
}

TEST(StopLatch, HoldsItsLevel) {
  StopLatch stop(true);
  stop.set(true);
  EXPECT_TRUE(stop.take_press());
  EXPECT_TRUE(stop.pressed());
  EXPECT_FALSE(stop.take_press());
}

}  // namespace
}  // namespace ols::station
