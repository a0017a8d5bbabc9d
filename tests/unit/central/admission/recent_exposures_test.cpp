#include "central/admission/recent_exposures.h"

#include <gtest/gtest.h>

namespace ols::fusion {
namespace {

constexpr std::int64_t kStart = 1'600'000'000'000'000;

BearingMeasurement bearing(std::int64_t utime_us, double azimuth_rad, std::int64_t track_id = 0) {
  BearingMeasurement measurement;
  measurement.utime_us = utime_us;
  measurement.sight.direction.azimuth_rad = azimuth_rad;
  measurement.track_id = track_id;
  return measurement;
}

TEST(RecentExposures, ADuplicateHasTheStampAndTheDirectionOrTheTrackId) {
  RecentExposures exposures;
  exposures.add(bearing(kStart, 1.0, 7));
  EXPECT_TRUE(exposures.has(bearing(kStart, 1.0)));
  EXPECT_TRUE(exposures.has(bearing(kStart, 1.1, 7)));
  EXPECT_FALSE(exposures.has(bearing(kStart, 1.1)));
  EXPECT_FALSE(exposures.has(bearing(kStart + 1, 1.0, 7)));
}

TEST(RecentExposures, CountWhatCameInASecond) {
  RecentExposures exposures;
  for (int i = 0; i < 50; ++i) exposures.add(bearing(kStart + i * 20'000, 0.01 * i));
  EXPECT_NEAR(exposures.rate_hz(), 50.0, 1e-9);
  EXPECT_TRUE(exposures.is_flood(50.0));
  EXPECT_FALSE(exposures.is_flood(51.0));
  exposures.go_on_to(kStart + 1'500'000);  // half of them are older than a second
  EXPECT_FALSE(exposures.is_flood(26.0));
  EXPECT_TRUE(exposures.is_flood(25.0));
}

}  // namespace
}  // namespace ols::fusion
