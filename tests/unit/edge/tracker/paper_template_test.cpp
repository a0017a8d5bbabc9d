#include "edge/tracker/paper_template.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ols::tracker {
namespace {

// Eq. (5) by hand: two pixels' share of it.
TEST(PaperObjective, IsEquationFive) {
  Patch target{}, candidate{};
  MaskPatch target_mask{}, candidate_mask{};
  const double identical = paper_objective(target, target_mask, candidate, candidate_mask);
  EXPECT_DOUBLE_EQ(identical, kPatchArea);
  candidate[7] = 51.0F;  // |It - Ic| = 0.2
  EXPECT_NEAR(paper_objective(target, target_mask, candidate, candidate_mask),
              kPatchArea - 1.0 + 0.64, 1e-9);
  target_mask[7] = 255;
  candidate_mask[7] = 102;  // min(Mt, Mc) = 0.4
  EXPECT_NEAR(paper_objective(target, target_mask, candidate, candidate_mask),
              kPatchArea - 1.0 + std::exp(0.4) * 0.64, 1e-9);
}

}  // namespace
}  // namespace ols::tracker
