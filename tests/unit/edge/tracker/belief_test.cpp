#include "edge/tracker/belief.h"

#include <gtest/gtest.h>

namespace ols::tracker {
namespace {

TEST(Belief, FallsAndRisesOverSomeFrames) {
  Belief belief;
  belief.start();
  const FrameEvidence good{0.9, 0.6, 0.95, 1.0};
  const FrameEvidence gone{0.6, 0.6, 0.1, 0.3};
  for (int i = 0; i < 5; ++i) belief.update(good, 1.0 / 15.0);
  EXPECT_GT(belief.value(), 0.9);
  belief.update(gone, 1.0 / 30.0);
  EXPECT_GT(belief.value(), 0.5);
  for (int i = 0; i < 4; ++i) belief.update(gone, 1.0 / 15.0);
  EXPECT_LT(belief.value(), 0.2);
  belief.update(good, 1.0 / 30.0);
  EXPECT_LT(belief.value(), 0.5);
}

TEST(Belief, UsualIsWhatTheTargetHasLookedLikeOfLate) {
  Belief steady, varied;
  steady.start();
  varied.start();
  FrameEvidence seen{0.8, 0.3, 0.95, 1.0};
  for (int k = 0; k < 100; ++k) {
    steady.update(seen, 1.0 / 15.0);
    FrameEvidence beating = seen;
    beating.correlation = k % 2 == 0 ? 0.95 : 0.7;
    varied.update(beating, 1.0 / 15.0);
  }
  FrameEvidence other = seen;
  other.correlation = 0.7;
  EXPECT_FALSE(steady.usual(other));
  EXPECT_TRUE(varied.usual(other));
  EXPECT_TRUE(steady.usual(seen));
  other = seen;
  other.standing_out = 0.2;
  EXPECT_FALSE(varied.usual(other));
}

}  // namespace
}  // namespace ols::tracker
