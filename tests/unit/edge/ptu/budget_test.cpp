#include "edge/ptu/budget.h"

#include <gtest/gtest.h>

namespace ols::ptu {
namespace {

TEST(Budget, CyclesTakeWhatTheHeaderSays) {
  struct Case {
    int baud;
    double moving_ms, resting_ms;
  };
  for (const auto& [baud, moving_ms, resting_ms] :
       {Case{9600, 74.0, 48.0}, {19200, 38.0, 25.0}, {38400, 20.0, 14.0}, {115200, 8.0, 6.0}}) {
    EXPECT_NEAR(1e3 * longest_cycle_s(baud), moving_ms, 0.6) << baud;
    EXPECT_NEAR(1e3 * resting_cycle_s(baud), resting_ms, 0.6) << baud;
  }
}

TEST(Budget, ALineWithoutARateTakesNoTime) { EXPECT_EQ(byte_time_s(0), 0.0); }

}  // namespace
}  // namespace ols::ptu
