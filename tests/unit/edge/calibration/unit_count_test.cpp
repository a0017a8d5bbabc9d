#include "edge/calibration/unit_count.h"

#include <gtest/gtest.h>

#include "geometry/angles.h"

namespace ols::station {
namespace {

TEST(UnitCount, APrintedCountIsRecognisedByItsAxis) {
  AxisModel axis;
  axis.counts_per_turn = 112000;
  EXPECT_NEAR(count_of(axis), radians(360.0 / 112000.0), 1e-15);
  EXPECT_TRUE(is_count_of(axis, radians(11.5714 / 3600.0))) << "rounded";
  EXPECT_FALSE(is_count_of(axis, radians(23.1428 / 3600.0))) << "half steps";
  EXPECT_FALSE(is_count_of(axis, radians(5.7857 / 3600.0)));
  EXPECT_FALSE(is_count_of(axis, 0.0));
}

}  // namespace
}  // namespace ols::station
