#include "edge/sensors/gnss_reading.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace ols::sensors {
namespace {

// "at least RTK float" is a comparison.
TEST(GnssReading, ABetterFixIsGreater) {
  EXPECT_LT(GnssFix::kNone, GnssFix::k2D);
  EXPECT_LT(GnssFix::k2D, GnssFix::k3D);
  EXPECT_LT(GnssFix::k3D, GnssFix::kDifferential);
  EXPECT_LT(GnssFix::kDifferential, GnssFix::kRtkFloat);
  EXPECT_LT(GnssFix::kRtkFloat, GnssFix::kRtkFixed);
}

TEST(GnssReading, EachFixHasANameOfItsOwn) {
  std::set<std::string> names;
  const int best = static_cast<int>(GnssFix::kRtkFixed);
  for (int i = 0; i <= best; ++i) names.insert(to_string(static_cast<GnssFix>(i)));
  EXPECT_EQ(names.size(), static_cast<std::size_t>(best + 1));
  EXPECT_STREQ(to_string(GnssReading{}.fix), "no fix");
}

}  // namespace
}  // namespace ols::sensors
