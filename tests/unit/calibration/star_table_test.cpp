#include "calibration/star_table.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "geometry/angles.h"

namespace ols::calibration {
namespace {

// Polaris by the Hipparcos catalogue (ICRS, epoch 1991.25), moved to the table's epoch; the table
// has no motion so near the pole: 1.5 arc seconds.
TEST(StarTable, HasPolarisWhereItIs) {
  const auto polaris = table_star("HIP 11767");
  ASSERT_TRUE(polaris);
  const Star star = star_of(*polaris);
  constexpr double kArcsec = kPi / 648000.0;
  EXPECT_NEAR(star.dec_rad, radians(89.26413805), 2.0 * kArcsec);
  EXPECT_NEAR(star.ra_rad * std::cos(star.dec_rad), radians(37.94614689) * std::cos(star.dec_rad),
              2.0 * kArcsec);
  EXPECT_EQ(name_of(*polaris), "HIP 11767");
}

// Sirius moves fast: -0.546 and -1.223 arc seconds a year from 101.28854105, -16.71314306 at
// 1991.25.
TEST(StarTable, HasTheMotionToItsEpoch) {
  const Star sirius = star_of(*table_star("HIP 32349"));
  const double years = kStarTableEpoch - 1991.25;
  constexpr double kArcsec = kPi / 648000.0;
  EXPECT_NEAR(sirius.dec_rad, radians(-16.71314306) - 1.22308 * years * kArcsec, 0.1 * kArcsec);
}

TEST(StarTable, IsSortedAndToMagnitudeSeven) {
  EXPECT_TRUE(std::ranges::is_sorted(star_table(), {}, &TableStar::hip));
  EXPECT_EQ(std::ranges::max(star_table(), {}, &TableStar::magnitude_tenths).magnitude_tenths, 70);
  EXPECT_GT(star_table().size(), 15000U);
}

TEST(StarTable, KnowsNoOtherNames) {
  for (const char* name : {"HIP 4", "HIP", "HIP 11767x", "Polaris", ""}) {
    EXPECT_FALSE(table_star(name)) << name;
  }
}

}  // namespace
}  // namespace ols::calibration
