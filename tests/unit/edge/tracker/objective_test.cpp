#include "edge/tracker/objective.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

namespace ols::tracker {
namespace {

Template pattern() {
  Template made;
  for (std::size_t i = 0; i < kPatchArea; ++i) {
    const bool inside =
        i % kPatchSide > 7 && i % kPatchSide < 16 && i / kPatchSide > 7 && i / kPatchSide < 16;
    made.gray[i] = inside ? 40.0F : 150.0F;
  }
  made.contrast = 110.0F;
  return made;
}

TEST(Objective, IsOneForTheTemplateWhateverTheExposure) {
  const Template target = pattern();
  Objective objective(target);
  MaskPatch all;
  all.fill(255);
  objective.set_mask(all);
  Patch brighter = target.gray;
  for (float& value : brighter) value = 0.8F * value + 30.0F;
  for (const Patch& patch : {target.gray, brighter}) {
    EXPECT_NEAR(objective(patch, all).similarity, 1.0, 1e-4);
    EXPECT_NEAR(objective(patch, all).correlation, 1.0, 1e-4);
  }
  Patch blank;
  blank.fill(150.0F);
  EXPECT_LT(objective(blank, all).similarity, 0.8);
  EXPECT_NEAR(objective(blank, all).correlation, 0.0, 1e-6);
}

// Bright before the dark and dark before the bright: rarer, so it counts a little less.
TEST(Objective, AnInvertedTargetCorrelatesNearlyAsWell) {
  const Template target = pattern();
  const Objective objective(target);
  MaskPatch all;
  all.fill(255);
  Patch inverted = target.gray;
  for (float& value : inverted) value = 190.0F - value;
  const double correlation = objective(inverted, all).correlation;
  EXPECT_GT(correlation, 0.7);
  EXPECT_LT(correlation, 0.99);
}

// Eq. (5): only where both masks say foreground does a pixel count e-fold.
TEST(Objective, WeighsByTheLesserOfBothMasks) {
  const Template target = pattern();
  Objective objective(target);
  MaskPatch all;
  all.fill(255);
  objective.set_mask(all);
  const MaskPatch none{};
  EXPECT_NEAR(objective(target.gray, none).similarity, std::exp(-1.0), 1e-3);
  objective.set_mask(none);
  EXPECT_NEAR(objective(target.gray, all).similarity, 1.0, 1e-4);
}

}  // namespace
}  // namespace ols::tracker
