#include "dev/estimators/limits.h"

#include <gtest/gtest.h>

#include <limits>

namespace ols::bench {
namespace {

TEST(Limits, CountWhatMisses) {
  Limits limits;
  limits.at_most("a", 1.0, 1.0);
  limits.at_least("b", 1.0, 1.0);
  limits.within("c", 1.0, 0.9, 1.1);
  EXPECT_EQ(limits.missed(), 0);
  limits.at_most("a", 1.01, 1.0);
  limits.at_least("b", 0.99, 1.0);
  limits.within("c", 1.2, 0.9, 1.1);
  EXPECT_EQ(limits.missed(), 3);
}

// A measure that nothing was measured for does not hold.
TEST(Limits, NothingMisses) {
  Limits limits;
  limits.at_most("a", std::numeric_limits<double>::quiet_NaN(), 1.0);
  limits.at_least("b", std::numeric_limits<double>::quiet_NaN(), 1.0);
  EXPECT_EQ(limits.missed(), 2);
}

}  // namespace
}  // namespace ols::bench
