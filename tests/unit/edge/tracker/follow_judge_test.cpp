#include "edge/tracker/follow_judge.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ols::tracker {
namespace {

constexpr double kInterval_s = 1.0 / 30.0;

double after(double seconds, const FollowEvidence& evidence) {
  FollowJudge judge;
  for (double t = 0.0; t < seconds; t += kInterval_s) judge.update(evidence, kInterval_s);
  return judge.value();
}

double after_own(double own, const FollowEvidence& evidence) {
  FollowJudge judge;
  for (int k = 0; k < 15; ++k) judge.update({own, {}}, kInterval_s);
  for (int k = 0; k < 30; ++k) judge.update(evidence, kInterval_s);
  return judge.value();
}

TEST(FollowJudge, BelievesAProminentResponseThatIsNoBackground) {
  EXPECT_GT(after(0.5, {35.0, 2.0}), 0.8);
  EXPECT_LT(after(0.5, {12.0, 2.0}), after(0.5, {35.0, 2.0}));
}

TEST(FollowJudge, DoesNotBelieveWhatDiffersFromTheBackgroundNoMoreThanItsSurroundings) {
  EXPECT_LT(after_own(35.0, {20.0, 0.0}), 0.3);
}

TEST(FollowJudge, WithoutAnEarlierImageTheResponseDecides) {
  EXPECT_GT(after(0.5, {35.0, {}}), 0.6);
  EXPECT_LT(after_own(35.0, {10.0, {}}), 0.2);
}

// A small, weak or grey target never responds as a large one does.
TEST(FollowJudge, AWeakTargetIsJudgedByItsOwnResponse) {
  EXPECT_GT(after_own(18.0, {18.0, 0.8}), 0.6);
  EXPECT_LT(after_own(60.0, {18.0, 0.8}), 0.4);
}

TEST(FollowJudge, NoResponseOfItsOwnMakesNoiseATarget) {
  EXPECT_LT(after_own(7.0, {7.0, 0.8}), 0.3);
}

FollowJudge judged(const FollowEvidence& evidence) {
  FollowJudge judge;
  for (int k = 0; k < 30; ++k) judge.update(evidence, kInterval_s);
  return judge;
}

TEST(FollowJudge, DoesNotBelieveAnObjectInOtherColoursAndDoesNotDropIt) {
  const FollowJudge own = judged({35.0, 2.0, 0.8, 0.9}), other = judged({35.0, 2.0, -0.5, 0.9});
  EXPECT_GT(own.belief(), 0.9);
  EXPECT_LT(other.belief(), 0.5);
  EXPECT_EQ(own.value(), other.value());
}

TEST(FollowJudge, ColoursThatSeparateNothingDecideNothing) {
  const FollowJudge judge = judged({24.0, 0.8, -0.5, 0.0});
  EXPECT_EQ(judge.belief(), judge.value());
}

TEST(FollowJudge, AFrameDoesNotDecideAndAThirdOfASecondDoes) {
  EXPECT_GT(after(kInterval_s, {8.0, 0.0}), 0.5);
  EXPECT_LT(after(1.0 / 3.0, {8.0, 0.0}), 0.2);
}

TEST(FollowJudge, DoubtsSoonerThanItBelieves) {
  const FollowEvidence none{2.0, -1.0}, clear{80.0, 2.5};
  FollowJudge judge;
  judge.update(none, kInterval_s);
  EXPECT_NEAR(judge.value(), std::exp(-kInterval_s / 0.12), 0.005);
  for (int k = 0; k < 60; ++k) judge.update(none, kInterval_s);
  judge.update(clear, kInterval_s);
  EXPECT_NEAR(judge.value(), 1.0 - std::exp(-kInterval_s / 0.15), 0.005);
}

TEST(FollowJudge, IsWaryAfterADoubtUntilItBelievesAgain) {
  FollowJudge judge;
  while (!judge.doubts()) judge.update({8.0, 0.0}, kInterval_s);
  EXPECT_TRUE(judge.wary());
  while (judge.doubts()) judge.update({60.0, 2.0}, kInterval_s);
  EXPECT_FALSE(judge.believes());
  EXPECT_TRUE(judge.wary());
  while (!judge.believes()) judge.update({60.0, 2.0}, kInterval_s);
  EXPECT_FALSE(judge.wary());
}

TEST(FollowJudge, StartsAnewWithATargetThatIsNamed) {
  FollowJudge judge;
  for (int k = 0; k < 30; ++k) judge.update({8.0, 0.0}, kInterval_s);
  judge.start();
  EXPECT_EQ(judge.value(), 1.0);
}

}  // namespace
}  // namespace ols::tracker
