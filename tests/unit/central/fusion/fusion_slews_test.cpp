// How the fusion slews its stations.
#include <gtest/gtest.h>

#include <algorithm>

#include "central/fusion/fusion.h"
#include "tests/unit/central/flight.h"

namespace ols::fusion {
namespace {

using Eigen::Vector3d;
using test::flight;
using test::kStart;
using test::measurement_of;
using test::path;
using test::ray_to;
using test::site;

// A bearing or a status, whichever came last: a station may be set up again elsewhere.
TEST(Fusion, SlewsAStationFromWhereItsLastMessageTold) {
  Fusion fusion{FusionConfig{}};
  const Vector3d anew(0.0, -120.0, 2.0);
  std::optional<Slew> before, after;
  for (const BearingMeasurement& measurement : flight(4.0)) {
    const bool gone = measurement.utime_us > kStart + 2'000'000;
    if (gone && measurement.station == "a") continue;
    if (gone) fusion.know_station("a", {.camera_ecef = site().to_ecef(anew)});
    for (const Slew& slew : fusion.add(measurement).slews) {
      if (slew.station == "a") (gone ? after : before) = slew;
    }
  }
  ASSERT_TRUE(before && after);
  const double t_s = static_cast<double>(after->effect_utime_us - kStart) * 1e-6;
  const auto expected = measurement_of(ray_to("a", anew, path(t_s)), 0).sight.direction;
  EXPECT_NEAR(wrap_pi(after->direction.azimuth_rad - expected.azimuth_rad), 0.0, 2e-3);
  EXPECT_NEAR(after->direction.elevation_rad, expected.elevation_rad, 2e-3);
}

TEST(Fusion, SlewsEveryKnownStationAheadOfTheTarget) {
  FusionConfig config;
  Fusion fusion{config};
  const Vector3d lookout(0.0, 0.0, 30.0);
  fusion.know_station("lookout", {.camera_ecef = site().to_ecef(lookout)});
  std::int64_t last_us = 0;
  int slews = 0;
  for (const BearingMeasurement& measurement : flight(4.0)) {
    const FusionOutput output = fusion.add(measurement);
    if (output.slews.empty()) continue;
    EXPECT_GE(output.slews[0].utime_us - last_us, 90'000);
    last_us = output.slews[0].utime_us;
    if (last_us < kStart + 1'000'000) continue;
    ++slews;
    ASSERT_EQ(output.slews.size(), 5U);
    const Slew& slew = output.slews.back();
    ASSERT_EQ(slew.station, "lookout");
    EXPECT_EQ(slew.effect_utime_us, slew.utime_us + 150'000);
    const double t_s = static_cast<double>(slew.effect_utime_us - kStart) * 1e-6;
    const BearingMeasurement there = measurement_of(ray_to("lookout", lookout, path(t_s)), 0);
    const BearingMeasurement next = measurement_of(ray_to("lookout", lookout, path(t_s + 0.01)), 0);
    const auto& now = there.sight.direction;
    EXPECT_NEAR(wrap_pi(slew.direction.azimuth_rad - now.azimuth_rad), 0.0, 1e-3);
    EXPECT_NEAR(slew.direction.elevation_rad, now.elevation_rad, 1e-3);
    EXPECT_NEAR(slew.azimuth_rate_rad_s,
                wrap_pi(next.sight.direction.azimuth_rad - now.azimuth_rad) / 0.01, 5e-3);
    EXPECT_NEAR(slew.elevation_rate_rad_s,
                (next.sight.direction.elevation_rad - now.elevation_rad) / 0.01, 5e-3);
    EXPECT_GT(slew.direction_sd_rad, 0.0);
    EXPECT_LT(slew.direction_sd_rad, 0.01);
    EXPECT_EQ(slew.lease_s, config.slew.lease_s);
  }
  EXPECT_GT(slews, 20);
}

TEST(Fusion, StopsSlewingSomeTimeAfterTheLastPosition) {
  FusionConfig config;
  Fusion fusion{config};
  auto measurements = flight(6.0);
  std::erase_if(measurements, [](const BearingMeasurement& measurement) {
    return measurement.station != "a" && measurement.utime_us > kStart + 2'000'000;
  });
  std::int64_t last_slew_us = 0;
  bool without_position = false;
  for (const BearingMeasurement& measurement : measurements) {
    const FusionOutput output = fusion.add(measurement);
    if (!output.slews.empty()) last_slew_us = output.slews[0].utime_us;
    // One station alone: the position ends, its bearing-only track continues.
    if (!output.targets.empty() && output.targets[0].utime_us > kStart + 5'000'000) {
      EXPECT_NE(output.targets[0].estimate.solution, Solution::kOk);
      without_position = true;
    }
  }
  EXPECT_TRUE(without_position);
  EXPECT_GT(last_slew_us, kStart + 3'500'000);
  EXPECT_LT(last_slew_us, kStart + 4'500'000);
}

}  // namespace
}  // namespace ols::fusion
