#include "edge/command/manual_motion.h"

#include <gtest/gtest.h>

namespace ols::station {
namespace {

RateCommand rate(double pan_rad_s, double received_s = 10.0, std::int64_t sequence = 1) {
  return {{pan_rad_s, 0.0}, received_s, 0.3, 7, sequence};
}

TEST(ManualMotion, ARateIsInForceForFourFifthsOfItsLease) {
  ManualMotion motion;
  EXPECT_FALSE(motion.goal(10.0));
  motion.turn(rate(0.2));
  const auto goal = motion.goal(10.1);
  ASSERT_TRUE(goal);
  EXPECT_TRUE(goal->rate_only);
  EXPECT_EQ(goal->rate.pan_rad, 0.2);
  EXPECT_DOUBLE_EQ(goal->valid_until_s, 10.24) << "the servo halts then without being told";
  EXPECT_TRUE(motion.goal(10.239));
  EXPECT_FALSE(motion.goal(10.241));
}

TEST(ManualMotion, RatesOfZeroHaltAtOnce) {
  ManualMotion motion;
  motion.turn(rate(0.2));
  motion.turn(rate(0.0, 10.1, 2));
  EXPECT_FALSE(motion.goal(10.1));
}

TEST(ManualMotion, AnEarlierRateOfTheSameSenderDoesNotReplaceALaterOne) {
  ManualMotion motion;
  motion.turn(rate(0.0, 10.0, 5));
  EXPECT_TRUE(motion.overtakes(rate(0.2, 10.1, 4), 10.1));
  EXPECT_FALSE(motion.overtakes(rate(0.2, 10.1, 6), 10.1));
  EXPECT_FALSE(motion.overtakes(rate(0.2, 10.3, 4), 10.3)) << "blocks nothing after its lease";
  RateCommand other = rate(0.2, 10.1, 4);
  other.sender = 8;
  EXPECT_FALSE(motion.overtakes(other, 10.1));
}

TEST(ManualMotion, TheUnitIsToRestAtAnglesAndNotAtTheEndOfARate) {
  ManualMotion motion;
  motion.point({0.5, 0.1}, 10.0, 25.0);
  EXPECT_TRUE(motion.goal(10.2)->rests);
  motion.turn(rate(0.2, 10.2));
  EXPECT_FALSE(motion.goal(10.3)->rests);
}

TEST(ManualMotion, AnglesAndRatesReplaceEachOther) {
  ManualMotion motion;
  motion.turn(rate(0.2));
  motion.point({0.5, 0.1}, 10.1, 25.0);
  EXPECT_FALSE(motion.goal(10.2)->rate_only);
  EXPECT_EQ(motion.goal(20.0)->angles.pan_rad, 0.5);
  EXPECT_EQ(motion.goal(20.0)->time_s, 20.0) << "a goal that stands does not grow old";
  motion.turn(rate(0.2, 20.0, 2));
  EXPECT_FALSE(motion.goal(20.5)) << "the angles do not come back";
  motion.point({0.5, 0.1}, 21.0, 25.0);
  motion.clear();
  EXPECT_FALSE(motion.goal(21.0));
}

}  // namespace
}  // namespace ols::station
