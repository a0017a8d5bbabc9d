#include "edge/ptu/reference_watch.h"

#include <gtest/gtest.h>

namespace ols::ptu {
namespace {

ReferenceWatch driven() {
  ReferenceWatch watch;
  watch.ready();
  return watch;
}

void ready_again(ReferenceWatch& watch) {
  watch.rate_is(9600);
  watch.ready();
}

TEST(ReferenceWatch, TrustsAUnitAtFirst) { EXPECT_EQ(driven().cause(), std::nullopt); }

TEST(ReferenceWatch, DoubtsAUnitThatRanIntoALimit) {
  ReferenceWatch watch = driven();
  watch.while_driven({1, 0}, false);
  EXPECT_EQ(watch.cause(), PtuDoubtCause::kLimitHit);
  watch.while_driven({0, 3}, false);  // driven into the other axis' limits: not homed by that
  watch.ready();
  EXPECT_EQ(watch.cause(), PtuDoubtCause::kLimitHit);
  watch.acknowledge();
  EXPECT_EQ(watch.cause(), std::nullopt);
}

TEST(ReferenceWatch, TrustsAfterAPowerCycleOnlyAUnitWhoseBothAxesWereSeenToHome) {
  for (const PtuLimitHits& hits : {PtuLimitHits{2, 2}, {1, 1}, {2, 0}, {0, 2}, {0, 0}, {1, 2}}) {
    ReferenceWatch watch = driven();
    watch.power_cycled();
    watch.while_not_driven(hits, 9600, 1.0);
    watch.rate_is(9600);
    EXPECT_EQ(watch.cause(), PtuDoubtCause::kPowerCycle);  // until it is done
    watch.ready();
    EXPECT_EQ(watch.cause() == std::nullopt, hits.pan > 0 && hits.tilt > 0);
  }
}

TEST(ReferenceWatch, TakesNoiseAtAnotherRateForNothing) {
  ReferenceWatch watch = driven();
  watch.power_cycled();
  watch.while_not_driven({1, 1}, 38400, 1.0);
  ready_again(watch);
  EXPECT_EQ(watch.cause(), PtuDoubtCause::kPowerCycle);
}

// What was heard before the unit was ready says nothing of a power cycle after it.
TEST(ReferenceWatch, TakesAnOldHomingForNothing) {
  ReferenceWatch watch = driven();
  watch.while_not_driven({2, 2}, 9600, 1.0);
  ready_again(watch);
  watch.power_cycled();
  watch.ready();
  EXPECT_EQ(watch.cause(), PtuDoubtCause::kPowerCycle);
}

TEST(ReferenceWatch, TrustsAUnitThatWasHomedByHandWhileItWasDriven) {
  ReferenceWatch watch = driven();
  watch.while_driven({2, 2}, true);
  watch.power_cycled();
  watch.ready();
  EXPECT_EQ(watch.cause(), std::nullopt);
}

TEST(ReferenceWatch, DoubtsAUnitThatHitALimitOnTheWay) {
  ReferenceWatch watch = driven();
  watch.while_not_driven({1, 0}, 9600, 1.0);
  ready_again(watch);
  EXPECT_EQ(watch.cause(), PtuDoubtCause::kLimitHit);
}

TEST(ReferenceWatch, DoubtsAHomingThatWasInterrupted) {
  ReferenceWatch watch = driven();
  watch.while_not_driven({0, 2}, 9600, 1.0);
  watch.homing_interrupted();
  watch.while_not_driven({2, 0}, 9600, 2.0);
  ready_again(watch);
  EXPECT_EQ(watch.cause(), PtuDoubtCause::kHomingInterrupted);
}

TEST(ReferenceWatch, BelievesAfterABrokenHomingOnlyAWholeOneOfItsOwn) {
  ReferenceWatch watch = driven();
  watch.homing_ordered();
  watch.while_not_driven({1, 1}, 9600, 1.0);
  watch.homing_interrupted();
  watch.while_not_driven({2, 2}, 9600, 2.0);  // a unit that does not heed a halt goes on
  ready_again(watch);
  EXPECT_EQ(watch.cause(), PtuDoubtCause::kHomingInterrupted);
  watch.while_not_driven({2, 2}, 9600, 2.5);
  watch.power_cycled();  // or what looks like one
  ready_again(watch);
  EXPECT_EQ(watch.doubt(), (mount::ReferenceDoubt{true, false}));
  EXPECT_EQ(watch.cause(), PtuDoubtCause::kHomingInterrupted);
  watch.homing_ordered();
  EXPECT_FALSE(watch.saw_both_ends());
  watch.while_not_driven({2, 2}, 9600, 3.0);
  EXPECT_TRUE(watch.saw_both_ends());
  watch.homing_complete();
  ready_again(watch);
  EXPECT_EQ(watch.cause(), std::nullopt);
}

TEST(ReferenceWatch, KnowsForAWhileAtWhichRateAUnitHomes) {
  ReferenceWatch watch = driven();
  watch.while_not_driven({1, 0}, 9600, 1.0);
  EXPECT_EQ(watch.homes_at(10.0), 9600);
  EXPECT_FALSE(watch.homes_at(30.0));
  watch.restarts_at(38400, 40.0);
  EXPECT_EQ(watch.homes_at(41.0), 38400);
}

}  // namespace
}  // namespace ols::ptu
