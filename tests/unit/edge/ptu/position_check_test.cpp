#include "edge/ptu/position_check.h"

#include <gtest/gtest.h>

#include "tests/unit/edge/ptu/unit_replies.h"

namespace ols::ptu {
namespace {

using Verdict = PositionCheck::Verdict;

PtuReadings read_at(double time_s, double counts_s, std::int32_t wrong = 0, double half_s = 1e-3) {
  const auto reading = [=](double at_s) {
    return PtuReading{static_cast<std::int32_t>(counts_s * at_s), at_s, half_s / 2.0, half_s};
  };
  PtuReadings both{reading(time_s), reading(time_s + 0.01)};
  both[1].counts += wrong;
  return both;
}

class PositionCheckTest : public testing::Test {
 protected:
  Verdict take(double time_s, double counts_s, std::int32_t wrong = 0, double half_s = 1e-3) {
    return check_.take(read_at(time_s, counts_s, wrong, half_s), read_at(time_s, 0.0), {});
  }
  PositionCheck check_{d46_facts()};
};

TEST_F(PositionCheckTest, BelievesAMotionAndKnowsItsRate) {
  EXPECT_EQ(take(1.0, 1000.0), Verdict::kFirst);
  for (const double t : {1.025, 1.05, 1.075}) EXPECT_EQ(take(t, 1000.0), Verdict::kBelieved);
  const mount::AngleSample& sample = check_.sample();
  EXPECT_NEAR(sample.time_s, 1.08, 1e-6);
  EXPECT_NEAR(sample.angles.pan_rad, 1080.0 * d46_facts().pan.resolution_rad, 1e-4);
  EXPECT_NEAR(check_.rate_rad_s().pan_rad, 1000.0 * d46_facts().pan.resolution_rad, 3e-3);
  EXPECT_FALSE(check_.standing());
}

TEST_F(PositionCheckTest, RefusesReadingsThatContradictEachOther) {
  take(1.0, 0.0);
  EXPECT_EQ(take(1.025, 0.0), Verdict::kBelieved);
  EXPECT_EQ(take(1.05, 0.0, 100), Verdict::kRefused);  // a wrong digit
  EXPECT_EQ(take(1.075, 0.0), Verdict::kBelieved);
}

TEST_F(PositionCheckTest, RefusesAPlaceThatTheUnitCannotReach) {
  take(1.0, 0.0);
  take(1.025, 0.0);
  PtuReadings far = read_at(1.05, 0.0);
  for (PtuReading& reading : far) reading.counts = 2000;  // both agree
  EXPECT_EQ(check_.take(far, read_at(1.05, 0.0), {}), Verdict::kRefused);
}

TEST_F(PositionCheckTest, SaysNothingOfRepliesThatWereReadLate) {
  take(1.0, 0.0);
  EXPECT_EQ(take(1.025, 0.0, 0, 0.031), Verdict::kLate);
}

TEST_F(PositionCheckTest, BeginsAgainAfterAGap) {
  take(1.0, 0.0);
  EXPECT_EQ(take(1.025, 0.0), Verdict::kBelieved);
  EXPECT_EQ(take(1.4, 0.0), Verdict::kFirst);
}

TEST_F(PositionCheckTest, SeesAUnitStand) {
  EXPECT_FALSE(check_.standing());
  take(1.0, 0.0);
  take(1.025, 0.0);
  EXPECT_TRUE(check_.standing());
}

}  // namespace
}  // namespace ols::ptu
