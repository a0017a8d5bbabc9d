#include "edge/ptu/angle_intake.h"

#include <gtest/gtest.h>

#include "tests/unit/edge/ptu/unit_replies.h"

namespace ols::ptu {
namespace {

using Verdict = PositionCheck::Verdict;

// A cycle in which the unit stands; its replies come back to back, a while after the request.
PollCycle standing_cycle(double sent_s, const std::string& pan, const std::string& pan_again) {
  PollCycle cycle({}, {}, sent_s, 1e-4, 0.001);
  double at_s = sent_s + 0.002;
  for (const std::string& text : {pan, std::string("0"), std::string("0"), pan_again}) {
    cycle.take(reply(text, at_s, at_s + 5e-4), 0.0);
    at_s += 0.002;
  }
  return cycle;
}

class AngleIntakeTest : public testing::Test {
 protected:
  Verdict take(double time_s, const std::string& pan, const std::string& again) {
    return intake_.take(standing_cycle(time_s, pan, again), {}, time_s + 0.01);
  }
  AngleIntake intake_{PtuConfig{}, d46_facts()};
};

TEST_F(AngleIntakeTest, GivesASampleOfEachPlausibleCycle) {
  EXPECT_FALSE(intake_.angles_at(1.0));
  EXPECT_EQ(take(1.0, "100", "100"), Verdict::kFirst);
  EXPECT_FALSE(intake_.newest_s());
  EXPECT_EQ(take(1.025, "100", "100"), Verdict::kBelieved);
  EXPECT_EQ(take(1.05, "100", "900"), Verdict::kRefused);
  EXPECT_EQ(intake_.take_samples().size(), 1u);
  EXPECT_TRUE(intake_.take_samples().empty());
  EXPECT_NEAR(*intake_.newest_s(), 1.03, 0.01);
  EXPECT_EQ(intake_.last_good_s(), 1.035);
  EXPECT_NEAR(intake_.angles_at(9.0)->pan_rad, 100 * d46_facts().pan.resolution_rad, 1e-12);
}

TEST_F(AngleIntakeTest, AddsTheCommandedAccelerationToTheNextSample) {
  take(1.0, "0", "0");
  take(1.025, "0", "0");
  intake_.commanded({0.005, 0.0});
  intake_.commanded({0.002, 0.001});  // the greater one counts
  take(1.05, "0", "0");
  const auto samples = intake_.take_samples();
  ASSERT_EQ(samples.size(), 2u);
  EXPECT_EQ(samples[0].acceleration.pan_rad, 0.0);
  EXPECT_NEAR(samples[1].acceleration.pan_rad, 0.8 * 0.005 / 0.025, 1e-9);
  EXPECT_NEAR(samples[1].acceleration.tilt_rad, 0.8 * 0.001 / 0.025, 1e-9);
}

TEST_F(AngleIntakeTest, KeepsTheNewestSamplesWhenNobodyTakesThem) {
  for (int i = 0; i < 1100; ++i) take(1.0 + 0.025 * i, "0", "0");
  const auto samples = intake_.take_samples();
  EXPECT_EQ(samples.size(), 1000u);
  EXPECT_EQ(samples.back().time_s, *intake_.newest_s());
}

}  // namespace
}  // namespace ols::ptu
