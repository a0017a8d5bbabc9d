#include "land/geoid.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace ols::land {
namespace {

// Of NGA's test values for EGM96 (OUTPUT.DAT of its program F477), by longitude east: within the
// grid's error between its points.
TEST(Geoid, IsThatOfTheSurvey) {
  const Geoid geoid("egm96_15.gtx");
  EXPECT_NEAR(geoid.height_m(38.6281550, 269.7791550), -31.628, 0.1);
  EXPECT_NEAR(geoid.height_m(-14.6212170, 305.0211140), -2.969, 0.1);
  EXPECT_NEAR(geoid.height_m(46.8743190, 102.4487290), -43.575, 0.1);
  EXPECT_NEAR(geoid.height_m(-23.6174460, 133.8747120), 15.871, 0.1);
}

TEST(Geoid, LongitudesMayCountFromBothSides) {
  const Geoid geoid("egm96_15.gtx");
  EXPECT_NEAR(geoid.height_m(38.6, -90.2), geoid.height_m(38.6, 269.8), 1e-6);
}

TEST(Geoid, WithoutAGridThereIsNone) {
  EXPECT_THROW(Geoid("no_such_grid.gtx"), std::invalid_argument);
  EXPECT_THROW(Geoid(""), std::invalid_argument);
  EXPECT_THROW(Geoid("egm96_15.gtx +proj=noop"), std::invalid_argument);
}

}  // namespace
}  // namespace ols::land
