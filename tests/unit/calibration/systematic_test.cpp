#include "calibration/systematic.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/calibration/scene.h"

namespace ols::calibration {
namespace {

// A heading alone that is not known moves every direction by it, less towards the zenith.
TEST(Systematic, AHeadingsErrorIsSeenByTheCosineOfTheElevation) {
  StationMatrix covariance = StationMatrix::Zero();
  covariance(kHeading, kHeading) = 1e-8;
  UnitReading reading;
  reading.tilt.counts = 30.0 / 360.0 * 112000.0;
  const auto seen = systematic_direction(test::hill(), covariance, reading, {639.5, 479.5});
  EXPECT_NEAR(std::sqrt(seen->covariance_rad2(0, 0)), 1e-4 * std::cos(radians(30.0)), 1e-9);
  EXPECT_NEAR(seen->covariance_rad2(1, 1), 0.0, 1e-16);
  const VolumePrecision volume = volume_precision(test::hill(), covariance);
  EXPECT_NEAR(volume.worst_rad, 1e-4 / std::sqrt(2.0), 1e-9);
  EXPECT_LT(volume.rms_rad, volume.worst_rad);
}

}  // namespace
}  // namespace ols::calibration
