#include "edge/tracker/random.h"

#include <gtest/gtest.h>

namespace ols::tracker {
namespace {

TEST(Random, IsStandardNormalAndFixed) {
  Random random(1);
  double sum = 0.0;
  double squares = 0.0;
  constexpr int kDraws = 20000;
  for (int i = 0; i < kDraws; ++i) {
    const double value = random.gaussian();
    sum += value;
    squares += value * value;
  }
  EXPECT_NEAR(sum / kDraws, 0.0, 0.03);
  EXPECT_NEAR(squares / kDraws, 1.0, 0.05);
  Random a(3);
  Random b(3);
  EXPECT_EQ(a.gaussian(), b.gaussian());
}

}  // namespace
}  // namespace ols::tracker
