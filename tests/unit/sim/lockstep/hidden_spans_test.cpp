#include "sim/lockstep/hidden_spans.h"

#include <gtest/gtest.h>

namespace ols::sim {
namespace {

// Until the first station has lost the drone twice behind hills.
std::vector<HiddenSpan> ridge_walk(bool land_model) {
  const World world(load_scenario(std::string(OLS_SCENARIOS) + "/ridge.toml"), 1);
  Fidelity fidelity;
  fidelity.pictures = false;
  fidelity.land_model = land_model;
  Lockstep lockstep(world, fidelity);
  lockstep.run(33.0);
  return hidden_spans(world, lockstep.result());
}

TEST(HiddenSpans, WithAModelOfTheLandAreHiddenAsPredicted) {
  const auto spans = ridge_walk(true);
  ASSERT_EQ(spans.size(), 2U);
  for (const HiddenSpan& span : spans) {
    SCOPED_TRACE(span.from_s);
    EXPECT_EQ(span.station, "alfa");
    EXPECT_TRUE(span.predicted);
    EXPECT_EQ(span.lost, 0);
    EXPECT_GT(span.hidden, 0.7 * span.frames);
    EXPECT_LT(span.found_s.value_or(9.0), 0.3);
    ASSERT_TRUE(span.last);
    EXPECT_LT(std::abs(span.last->error_s), 4.0 * span.last->sd_s);
  }
}

TEST(HiddenSpans, WithoutOneNothingIsPredicted) {
  const auto spans = ridge_walk(false);
  ASSERT_EQ(spans.size(), 2U);
  for (const HiddenSpan& span : spans) {
    EXPECT_FALSE(span.predicted);
    EXPECT_EQ(span.hidden, 0);
    EXPECT_GT(span.slewed, 0);
  }
}

}  // namespace
}  // namespace ols::sim
