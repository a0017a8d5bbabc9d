#include "dev/estimators/several_targets.h"

#include <gtest/gtest.h>

namespace ols::bench {

namespace {

TEST(SeveralTargets, KeepTheirIdentitiesThroughCrossingsMissesAndFalseBearings) {
  constexpr int kSeeds = 3;
  double right = 0.0;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    const IdentityScore score = run_several({.duration_s = 20.0}, static_cast<std::uint64_t>(seed));
    right += score.by_right_identity / kSeeds;
    EXPECT_LE(score.longest_ghost_s, 1.0) << "seed " << seed;
    EXPECT_GE(score.by_right_identity, 0.9) << "seed " << seed;
  }
  EXPECT_GE(right, 0.95);
}

// Ten targets that cross; every station has a false tracklet in each image, too.
TEST(SeveralTargets, OfDetectorsAreFoundAndNoGhostIsPublished) {
  const IdentityScore score =
      run_several({.targets = 10, .duration_s = 12.0, .tracklets = true}, 1);
  EXPECT_GE(score.found, 0.95);
  EXPECT_GE(score.by_right_identity, 0.9);
  EXPECT_EQ(score.ghosts, 0);
}

TEST(SeveralTargets, OneTargetWithoutClutterIsTrackedThroughout) {
  const IdentityScore score =
      run_several({.targets = 1, .duration_s = 10.0, .missed = 0.0, .false_per_frame = 0.0}, 1);
  EXPECT_EQ(score.by_right_identity, 1.0);
  EXPECT_EQ(score.switches, 0);
  EXPECT_LT(score.rms_m, 0.3);
}

}  // namespace
}  // namespace ols::bench
