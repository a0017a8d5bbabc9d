#include "base/bus/boot_id.h"

#include <gtest/gtest.h>

#include <set>

namespace ols {
namespace {

TEST(BootId, IsANewOneEachTimeAndNeverNegative) {
  std::set<std::int64_t> drawn;
  for (int i = 0; i < 1000; ++i) drawn.insert(draw_boot_id());
  EXPECT_EQ(drawn.size(), 1000U);
  EXPECT_GE(*drawn.begin(), 0);
  EXPECT_GT(*drawn.rbegin(), std::int64_t{1} << 62) << "all 63 bits are drawn";
}

}  // namespace
}  // namespace ols
