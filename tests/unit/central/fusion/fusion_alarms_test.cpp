// The fusion's alarms about stations that follow an object that no other station follows.
#include <gtest/gtest.h>

#include <algorithm>

#include "central/fusion/fusion.h"
#include "tests/unit/central/flight.h"

namespace ols::fusion {
namespace {

using test::flight;
using test::kStart;

// The stations of a flight; d points away from the others' object by a growing angle: another
// object, or the background.
std::vector<BearingMeasurement> with_a_stray(double seconds) {
  auto measurements = flight(seconds);
  for (BearingMeasurement& measurement : measurements) {
    measurement.track_id = 1;
    if (measurement.station != "d") continue;
    const double t_s = static_cast<double>(measurement.utime_us - kStart) * 1e-6;
    double& azimuth = measurement.sight.direction.azimuth_rad;
    azimuth = wrap_two_pi(azimuth + 0.7 + 0.05 * t_s);
  }
  return measurements;
}

std::vector<Alarm> alarms_after(const std::vector<BearingMeasurement>& measurements) {
  Fusion fusion{FusionConfig{}};
  for (const BearingMeasurement& measurement : measurements) fusion.add(measurement);
  return fusion.health().alarms;
}

TEST(FusionAlarms, NamesWhoFollowsForLongWhatIsNoneOfTheTargets) {
  const auto alarms = alarms_after(with_a_stray(14.0));
  ASSERT_EQ(alarms.size(), 1U);
  EXPECT_TRUE(alarms[0].text.starts_with("station d: has followed for 1")) << alarms[0].text;
}

// A constant error: its pose may be wrong, which is another alarm, and one is enough.
TEST(FusionAlarms, NamesWhoIsQuarantined) {
  auto measurements = flight(14.0);
  for (BearingMeasurement& measurement : measurements) {
    measurement.track_id = 1;
    double& azimuth = measurement.sight.direction.azimuth_rad;
    if (measurement.station == "d") azimuth = wrap_two_pi(azimuth + 0.1);
  }
  const auto alarms = alarms_after(measurements);
  ASSERT_EQ(alarms.size(), 1U);
  EXPECT_TRUE(alarms[0].text.starts_with("station d: not used, its bearings are 5"))
      << alarms[0].text;
}

TEST(FusionAlarms, SaysNothingOfWhoDoesSoForAMoment) {
  EXPECT_TRUE(alarms_after(with_a_stray(8.0)).empty());
}

TEST(FusionAlarms, SaysNothingOfStationsThatFollowATarget) {
  auto measurements = flight(14.0);
  for (BearingMeasurement& measurement : measurements) measurement.track_id = 1;
  EXPECT_TRUE(alarms_after(measurements).empty());
}

// Detections without a track id are of many objects, most of them no targets.
TEST(FusionAlarms, SaysNothingOfWhatAStationDoesNotName) {
  auto measurements = with_a_stray(14.0);
  for (BearingMeasurement& measurement : measurements) {
    if (measurement.station == "d") measurement.track_id = 0;
  }
  EXPECT_TRUE(alarms_after(measurements).empty());
}

TEST(FusionAlarms, SaysNothingWhereThereIsNoTargetToCompareWith) {
  auto measurements = with_a_stray(14.0);
  std::erase_if(measurements,
                [](const BearingMeasurement& s) { return s.station == "b" || s.station == "c"; });
  EXPECT_TRUE(alarms_after(measurements).empty());
}

// A station that follows two objects by two track ids has one of the targets in view.
TEST(FusionAlarms, SaysNothingOfWhoFollowsTheTargetBesideAnotherObject) {
  auto measurements = with_a_stray(14.0);
  std::vector<BearingMeasurement> both;
  const auto straight = flight(14.0);
  for (std::size_t i = 0; i < measurements.size(); ++i) {
    both.push_back(measurements[i]);
    if (measurements[i].station != "d") continue;
    both.push_back(straight[i]);
    both.back().track_id = 2;
  }
  EXPECT_TRUE(alarms_after(both).empty());
}

TEST(FusionAlarms, TheAlarmGoesWithItsReason) {
  Fusion fusion{FusionConfig{}};
  for (const BearingMeasurement& measurement : with_a_stray(14.0)) fusion.add(measurement);
  ASSERT_FALSE(fusion.health().alarms.empty());
  auto onwards = flight(16.0);
  for (BearingMeasurement& measurement : onwards) {
    measurement.track_id = measurement.station == "d" ? 2 : 1;  // designated again
    if (measurement.utime_us > kStart + 14'000'000) fusion.add(measurement);
  }
  EXPECT_TRUE(fusion.health().alarms.empty());
}

}  // namespace
}  // namespace ols::fusion
