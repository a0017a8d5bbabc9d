// Which bearings the fusion admits, and what happens to the others.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>

#include "central/fusion/fusion.h"
#include "tests/unit/central/flight.h"

namespace ols::fusion {
namespace {

using test::error_m;
using test::flight;
using test::kStart;
using test::site;
using test::targets_of;

std::vector<std::string> names(const Fusion& fusion) {
  std::vector<std::string> all;
  for (const StationHealth& station : fusion.health().stations) all.push_back(station.station);
  return all;
}

TEST(FusionAdmission, WhatIsNotABearingIsRefusedAndCounted) {
  Fusion fusion{FusionConfig{}};
  const BearingMeasurement good = flight(0.1).front();
  BearingMeasurement bad = good;
  bad.sight.direction.azimuth_rad = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(fusion.add(bad).refusal, BearingRefusal::kNotFinite);
  bad = good;
  bad.belief = 0.1;
  EXPECT_EQ(fusion.add(bad).refusal, BearingRefusal::kLowBelief);
  EXPECT_EQ(fusion.add(good).refusal, BearingRefusal::kNone);
  EXPECT_EQ(fusion.add(good).refusal, BearingRefusal::kDuplicate);
  const auto counters = fusion.health().counters;
  EXPECT_EQ(counters.at("refused_not_finite"), 1.0);
  EXPECT_EQ(counters.at("unused_low_belief"), 1.0);
  EXPECT_EQ(counters.at("refused_duplicate"), 1.0);
  EXPECT_EQ(counters.at("bearings"), 1.0);
}

TEST(FusionAdmission, AFloodOfOneStationIsRefusedByNameAndTheOthersGoOn) {
  Fusion fusion{FusionConfig{.admission = {.flood_hz = 200.0}}};
  std::vector<FusedTarget> targets;
  for (const BearingMeasurement& measurement : flight(4.0)) {
    for (const FusedTarget& target : fusion.add(measurement).targets) targets.push_back(target);
    for (int i = 0; measurement.station == "a" && i < 50; ++i) {
      BearingMeasurement more = measurement;
      more.sight.direction.azimuth_rad = wrap_two_pi(0.01 * i + 0.1);
      fusion.add(more);
    }
  }
  EXPECT_GT(fusion.health().counters.at("refused_flood"), 1000.0);
  EXPECT_EQ(targets.back().estimate.solution, Solution::kOk);
  EXPECT_LT(error_m(targets.back()), 0.05);
}

TEST(FusionAdmission, AfterAFloodItsStationIsHeardAgain) {
  Fusion fusion{FusionConfig{.admission = {.flood_hz = 200.0}}};
  int taken = 0;
  for (const BearingMeasurement& measurement : flight(5.0)) {
    const bool refused = fusion.add(measurement).refusal != BearingRefusal::kNone;
    if (measurement.station != "a") continue;
    if (!refused && measurement.utime_us > kStart + 3'500'000) ++taken;
    for (int i = 0; measurement.utime_us < kStart + 2'000'000 && i < 50; ++i) {
      BearingMeasurement more = measurement;
      more.utime_us += i;
      more.sight.direction.azimuth_rad = wrap_two_pi(0.01 * i + 0.1);
      fusion.add(more);
    }
  }
  EXPECT_EQ(taken, 22);
  EXPECT_NEAR(fusion.health().stations.front().rate_hz, 15.0, 0.5);
}

TEST(FusionAdmission, WhoDoesNotBelongToTheSiteIsRefused) {
  Fusion fusion{FusionConfig{.admission = {.stations = {"a", "b", "d"}}}};
  const auto targets = targets_of(fusion, flight(2.0));
  fusion.know_station("stranger", {});
  EXPECT_EQ(fusion.health().counters.at("refused_unknown_station"), 30.0);
  EXPECT_EQ(names(fusion), (std::vector<std::string>{"a", "b", "d"}));
  EXPECT_LT(error_m(targets.back()), 0.05);
}

// A heading that is 5 degrees off: the station is named, and the others' target stays.
TEST(FusionAdmission, AWrongHeadingIsQuarantinedByNameAndTheOthersGoOn) {
  auto measurements = flight(10.0);
  for (BearingMeasurement& measurement : measurements) {
    double& azimuth = measurement.sight.direction.azimuth_rad;
    if (measurement.station == "b") azimuth = wrap_two_pi(azimuth + radians(5.0));
  }
  Fusion fusion{FusionConfig{}};
  const auto targets = targets_of(fusion, measurements);
  for (const FusedTarget& target : targets) {
    if (target.utime_us < kStart + 1'000'000) continue;
    ASSERT_EQ(target.estimate.solution, Solution::kOk);
    EXPECT_LT(error_m(target), 0.05);
    EXPECT_EQ(target.target_id, 1);
  }
  for (const StationHealth& station : fusion.health().stations) {
    const bool named = station.quarantine.text.find("deg off") != std::string::npos;
    EXPECT_EQ(named, station.station == "b") << station.station << ": " << station.quarantine.text;
  }
  EXPECT_GT(fusion.health().counters.at("refused_quarantine"), 10.0);
}

// The smallest and the largest admitted variances, in every combination, from a station that does
// not see the target: the others' position stays.
TEST(FusionAdmission, NoStatementOfOneStationKeepsTheOthersFromAPosition) {
  for (const double white : {1e-18, 10.0}) {
    for (const double stays : {0.0, 10.0}) {
      for (const double large : {0.0, 1.0}) {
        auto measurements = flight(3.0);
        for (BearingMeasurement& measurement : measurements) {
          if (measurement.station != "b") continue;
          measurement.sight.direction = {3.0, -0.5};
          measurement.sight.covariance_white = Eigen::Matrix2d::Identity() * white;
          measurement.sight.covariance_systematic = Eigen::Matrix2d::Identity() * stays;
          measurement.sight.origin_sd_enu_m.setConstant(large * 1e6);
          measurement.clock_sd_s = large * 1e4;
          ASSERT_EQ(check(measurement), BearingRefusal::kNone);
        }
        Fusion fusion{FusionConfig{}};
        for (const FusedTarget& target : targets_of(fusion, measurements)) {
          if (target.utime_us < kStart + 1'000'000) continue;
          ASSERT_EQ(target.estimate.solution, Solution::kOk)
              << white << " " << stays << " " << large;
          EXPECT_LT(error_m(target), 0.1) << white << " " << stays << " " << large;
        }
      }
    }
  }
}

TEST(FusionAdmission, StrangeStationsNeitherFillThePlacesNorMakeItGrow) {
  Fusion fusion{FusionConfig{.admission = {.max_stations = 64}}};
  BearingMeasurement stranger = flight(0.1).front();
  for (int i = 0; i < 80; ++i) {
    stranger.station = "stranger" + std::to_string(i);
    fusion.add(stranger);
  }
  EXPECT_EQ(fusion.health().stations.size(), 64U);
  const auto targets = targets_of(fusion, flight(3.0));
  ASSERT_GT(targets.size(), 30U);
  EXPECT_EQ(targets.back().estimate.solution, Solution::kOk);
  EXPECT_EQ(targets.back().stations.size(), 4U);
  EXPECT_LT(error_m(targets.back()), 0.05);
  EXPECT_EQ(fusion.health().stations.size(), 64U);
  EXPECT_EQ(fusion.health().counters.at("stations_evicted"), 20.0);
}

TEST(FusionAdmission, ForgetsTheStationThatIsSilentLongest) {
  Fusion fusion{FusionConfig{.admission = {.max_stations = 5}}};
  fusion.know_station("lookout", {.camera_ecef = site().to_ecef({0.0, 0.0, 30.0})});
  auto measurements = flight(1.0);
  std::erase_if(measurements, [](const BearingMeasurement& measurement) {
    return measurement.station == "a" && measurement.utime_us > kStart + 500'000;
  });
  targets_of(fusion, measurements);
  BearingMeasurement next = measurements.back();
  next.station = "x";
  EXPECT_EQ(fusion.add(next).refusal, BearingRefusal::kNone);
  EXPECT_EQ(names(fusion), (std::vector<std::string>{"a", "b", "c", "d", "x"}));
  next.station = "y";
  EXPECT_EQ(fusion.add(next).refusal, BearingRefusal::kNone);
  EXPECT_EQ(names(fusion), (std::vector<std::string>{"b", "c", "d", "x", "y"}));
  // A status alone does not replace a station that has sent a moment ago...
  fusion.know_station("lookout", {.camera_ecef = site().to_ecef({0.0, 0.0, 30.0})});
  EXPECT_EQ(names(fusion), (std::vector<std::string>{"b", "c", "d", "x", "y"}));
  // ... but one that has long been silent.
  auto later = flight(13.0);
  std::erase_if(later, [&](const BearingMeasurement& measurement) {
    return measurement.station == "a" || measurement.utime_us <= next.utime_us;
  });
  targets_of(fusion, later);
  fusion.know_station("lookout", {.camera_ecef = site().to_ecef({0.0, 0.0, 30.0})});
  EXPECT_EQ(names(fusion), (std::vector<std::string>{"b", "c", "d", "lookout", "y"}));
}

}  // namespace
}  // namespace ols::fusion
