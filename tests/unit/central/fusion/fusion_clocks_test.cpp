// Stations whose clock, calibration or message time changes.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "central/fusion/fusion.h"
#include "tests/unit/central/flight.h"

namespace ols::fusion {
namespace {

using test::error_m;
using test::flight;
using test::kStart;
using test::targets_of;

// The flight with one station's bearings changed from an instant on.
std::vector<BearingMeasurement> changed(std::vector<BearingMeasurement> measurements,
                                        const std::string& station, double from_s,
                                        const std::function<void(BearingMeasurement&)>& change) {
  for (BearingMeasurement& measurement : measurements) {
    const double t_s = static_cast<double>(measurement.utime_us - kStart) * 1e-6;
    if (measurement.station == station && t_s >= from_s) change(measurement);
  }
  return measurements;
}

std::string quarantined(const Fusion& fusion) {
  std::string names;
  for (const StationHealth& station : fusion.health().stations) {
    if (!station.quarantine.empty()) names += station.station;
  }
  return names;
}

// Nine in a row come with any start or stall of a network; ten are said.
TEST(FusionClocks, AFewUntimelyBearingsAreCountedAndManyAreAnError) {
  for (const int late : {9, 10}) {
    int number = 0;
    Fusion fusion{FusionConfig{}};
    targets_of(fusion, changed(flight(4.0), "b", 3.0, [&](BearingMeasurement& measurement) {
                 if (number++ < late) measurement.utime_us -= 5'000'000;
               }));
    EXPECT_EQ(fusion.health().counters.at("refused_stale"), late);
    EXPECT_EQ(fusion.health().last_error.find("come too late") != std::string::npos, late == 10);
  }
}

TEST(FusionClocks, AMarkedStepQuarantinesThatStationAloneAndTheOthersGoOn) {
  for (const std::int64_t step_us : {2'000'000, -2'000'000}) {
    const auto measurements = changed(flight(6.0), "b", 3.0, [&](BearingMeasurement& measurement) {
      measurement.utime_us += step_us;
      measurement.clock = StationClock::kUnsynchronised;
      measurement.clock_sd_s = 2.0;
    });
    Fusion fusion{FusionConfig{}};
    int after = 0;
    for (const FusedTarget& target : targets_of(fusion, measurements)) {
      const double t_s = static_cast<double>(target.utime_us - kStart) * 1e-6;
      if (t_s < 1.0) continue;
      ASSERT_EQ(target.estimate.solution, Solution::kOk) << t_s;
      EXPECT_LT(error_m(target), 0.05) << t_s;
      if (t_s < 3.1) continue;
      ++after;
      EXPECT_TRUE(std::ranges::none_of(
          target.stations, [](const ContributingStation& s) { return s.station == "b"; }));
    }
    EXPECT_GT(after, 30) << "targets go on without a pause";
    EXPECT_EQ(quarantined(fusion), "b");
    EXPECT_EQ(fusion.health().counters.at("stations_quarantined"), 1.0);
    EXPECT_GT(fusion.health().counters.at("refused_quarantine"), 35.0);
    EXPECT_NE(fusion.health().last_error.find("station b: not used"), std::string::npos);
  }
}

TEST(FusionClocks, OfTwoStationsTheMarkedOneIsSetAsideAndTheOtherKeepsTheTime) {
  auto measurements = changed(flight(6.0), "a", 3.0, [&](BearingMeasurement& measurement) {
    measurement.utime_us -= 2'000'000;
    measurement.clock = StationClock::kUnsynchronised;
    measurement.clock_sd_s = 2.0;
  });
  std::erase_if(measurements, [](const BearingMeasurement& s) { return s.station > "b"; });
  Fusion fusion{FusionConfig{}};
  targets_of(fusion, measurements);
  EXPECT_EQ(quarantined(fusion), "a");
  EXPECT_GT(fusion.now_us(), kStart + 5'800'000);
  EXPECT_EQ(fusion.health().counters.at("refused_future"), 0.0) << "nothing of the good one";
}

TEST(FusionClocks, AQuarantinedStationIsStillSlewed) {
  const auto measurements =
      changed(flight(4.0), "b", 2.0, [](BearingMeasurement& s) { s.clock_sd_s = 2.0; });
  Fusion fusion{FusionConfig{}};
  bool slewed = false;
  for (const BearingMeasurement& measurement : measurements) {
    const FusionOutput output = fusion.add(measurement);
    if (measurement.utime_us < kStart + 3'000'000) continue;
    for (const Slew& slew : output.slews) slewed = slewed || slew.station == "b";
  }
  EXPECT_TRUE(slewed) << "whether it may heed them, its own gate decides by its own clock";
}

TEST(FusionClocks, AStatedErrorInflatesAlongTheMotion) {
  const auto trace_with = [](double error_s) {
    auto measurements = flight(3.0);
    for (BearingMeasurement& measurement : measurements) measurement.clock_sd_s = error_s;
    Fusion fusion{FusionConfig{}};
    return targets_of(fusion, measurements).back().estimate.covariance_ecef.trace();
  };
  // 20 m/s for 50 ms are a metre, and averaging four stations does not remove it.
  EXPECT_LT(trace_with(0.0), 0.01);
  EXPECT_GT(trace_with(0.05), 0.1);
}

// The fusion was restarted while the stations continued.
TEST(FusionClocks, AFusionThatBeginsInMidFlightLocatesAtOnce) {
  Fusion fusion{FusionConfig{}};
  for (const FusedTarget& target : targets_of(fusion, flight(1.0))) {
    if (target.utime_us < kStart + 200'000) continue;
    EXPECT_EQ(target.estimate.solution, Solution::kOk);
    EXPECT_LT(error_m(target), 0.1);
  }
}

TEST(FusionClocks, AnotherCalibrationStartsAnew) {
  const auto measurements =
      changed(flight(4.0), "c", 2.0, [](BearingMeasurement& s) { s.calibration_id = 77; });
  Fusion fusion{FusionConfig{}};
  const auto targets = targets_of(fusion, measurements);
  EXPECT_EQ(fusion.health().counters.at("calibrations_changed"), 1.0);
  EXPECT_EQ(targets.back().stations.size(), 4U);
  EXPECT_LT(error_m(targets.back()), 0.05);
}

TEST(FusionClocks, StrangersCannotPushOutWhoWorksHere) {
  Fusion fusion{FusionConfig{.admission = {.max_stations = 4}}};
  const auto measurements = flight(4.0);
  double refused = 0.0;
  for (std::size_t i = 0; i < measurements.size(); ++i) {
    fusion.add(measurements[i]);
    if (measurements[i].utime_us < kStart + 1'000'000) continue;
    BearingMeasurement stranger = measurements[i];
    stranger.station = "stranger" + std::to_string(i);
    EXPECT_EQ(fusion.add(stranger).refusal, BearingRefusal::kTooMany);
    ++refused;
  }
  EXPECT_EQ(fusion.health().counters.at("refused_too_many_stations"), refused);
  EXPECT_EQ(fusion.health().counters.at("stations_evicted"), 0.0);
  EXPECT_EQ(fusion.health().stations.size(), 4U);
}

}  // namespace
}  // namespace ols::fusion
