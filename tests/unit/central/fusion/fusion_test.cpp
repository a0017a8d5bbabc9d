#include "central/fusion/fusion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/unit/central/flight.h"

namespace ols::fusion {
namespace {

using Eigen::Vector3d;
using test::error_m;
using test::flight;
using test::kStart;
using test::path;
using test::ray_to;
using test::site;
using test::square;
using test::targets_of;

constexpr std::int64_t kHour = 3'600'000'000;

TEST(Fusion, FollowsAMovingTargetWithStaggeredStations) {
  Fusion fusion{FusionConfig{}};
  const auto targets = targets_of(fusion, flight(4.0));
  ASSERT_GT(targets.size(), 40U);
  EXPECT_LE(targets.size(), 67U);
  for (std::size_t i = 10; i < targets.size(); ++i) {
    ASSERT_EQ(targets[i].estimate.solution, Solution::kOk);
    EXPECT_EQ(targets[i].stations.size(), 4U);
    EXPECT_LT(error_m(targets[i]), 0.02);
    const Vector3d velocity = site().R_ecef_enu().transpose() * targets[i].estimate.velocity_ecef;
    EXPECT_LT((velocity - Vector3d(20, -5, 2)).norm(), 0.3);
  }
}

TEST(Fusion, ReplayGivesTheSameToTheLastDigit) {
  const auto measurements = flight(3.0, 1e-4, 1e-4);
  Fusion first{FusionConfig{}}, second{FusionConfig{}};
  const auto a = targets_of(first, measurements), b = targets_of(second, measurements);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].utime_us, b[i].utime_us);
    if (a[i].estimate.solution != Solution::kOk) continue;
    EXPECT_EQ(a[i].estimate.position_ecef, b[i].estimate.position_ecef);
    EXPECT_EQ(a[i].estimate.covariance_ecef, b[i].estimate.covariance_ecef);
  }
}

TEST(Fusion, PaperEstimateStandsBesideTheJointOne) {
  Fusion fusion{FusionConfig{}};
  int both = 0;
  for (const BearingMeasurement& measurement : flight(3.0)) {
    const FusionOutput output = fusion.add(measurement);
    if (output.targets.empty() || output.targets[0].estimate.solution != Solution::kOk) continue;
    ++both;
    ASSERT_EQ(output.targets_paper.size(), 1U);
    const FusedTarget& paper = output.targets_paper[0];
    ASSERT_EQ(paper.estimate.solution, Solution::kOk);
    EXPECT_EQ(paper.target_id, output.targets[0].target_id);
    // Lags by the moving average, at most ten targets, and its covariance contains that.
    const double off_m = error_m(paper);
    EXPECT_LT(off_m, 21.0 * 10 / 12.0);
    EXPECT_LT(off_m, 3.0 * std::sqrt(paper.estimate.covariance_ecef.trace()) + 0.1);
  }
  EXPECT_GT(both, 30);
}

// One wrong clock affects only its own station, whichever station it is, whether fast or slow, and
// also if it sends first.
TEST(Fusion, OneWrongClockHurtsOnlyItsOwner) {
  for (const std::string wrong : {"a", "b", "d"}) {
    for (const std::int64_t offset : {kHour, -kHour, std::int64_t{5'000'000}}) {
      Fusion fusion{FusionConfig{}};
      auto measurements = flight(4.0);
      for (BearingMeasurement& measurement : measurements) {
        if (measurement.station == wrong) measurement.utime_us += offset;
      }
      const auto targets = targets_of(fusion, measurements);
      const auto good = std::ranges::count_if(targets, [&](const FusedTarget& target) {
        return target.estimate.solution == Solution::kOk && target.stations.size() == 3;
      });
      EXPECT_GT(good, 40) << wrong << " " << offset;
      const auto health = fusion.health();
      const char* counter = offset > 0 ? "refused_future" : "refused_stale";
      const double at_first = health.counters.at(counter);
      EXPECT_GT(at_first, 10.0) << wrong << " " << offset;
      EXPECT_GT(at_first + health.counters.at("refused_quarantine"), 55.0) << wrong;
      for (const StationHealth& station : health.stations) {
        EXPECT_EQ(station.quarantine.empty(), station.station != wrong) << station.quarantine.text;
      }
      EXPECT_NE(health.last_error.find("station " + wrong), std::string::npos);
      for (const FusedTarget& target : targets) {
        // Until the others send, the wrong clock alone is the time: no position then.
        const bool warm = target.utime_us > kStart + 1'000'000;
        if (warm && target.estimate.solution == Solution::kOk) {
          EXPECT_LT(error_m(target), 0.05);
        }
      }
    }
  }
}

TEST(Fusion, TakesLateAndDoubledBearings) {
  auto measurements = flight(3.0);
  for (std::size_t i = 20; i + 3 < measurements.size(); i += 10) {
    std::swap(measurements[i], measurements[i + 3]);
  }
  std::vector<BearingMeasurement> doubled;
  for (const BearingMeasurement& measurement : measurements) {
    doubled.push_back(measurement);
    doubled.push_back(measurement);
  }
  Fusion fusion{FusionConfig{}};
  const auto targets = targets_of(fusion, doubled);
  EXPECT_EQ(fusion.health().counters.at("refused_duplicate"),
            static_cast<double>(measurements.size()));
  for (std::size_t i = 10; i < targets.size(); ++i) EXPECT_LT(error_m(targets[i]), 0.05);
}

TEST(Fusion, GoesOnWhenStationsDropOutAndReturn) {
  auto measurements = flight(6.0);
  std::erase_if(measurements, [](const BearingMeasurement& measurement) {
    const double t_s = static_cast<double>(measurement.utime_us - kStart) * 1e-6;
    return measurement.station > "b" && t_s > 2.0 && t_s < 4.0;  // two of four at once
  });
  Fusion fusion{FusionConfig{}};
  const auto targets = targets_of(fusion, measurements);
  std::int64_t longest_us = 0;
  for (std::size_t i = 1; i < targets.size(); ++i) {
    longest_us = std::max(longest_us, targets[i].utime_us - targets[i - 1].utime_us);
    const double t_s = static_cast<double>(targets[i].utime_us - kStart) * 1e-6;
    if (t_s > 2.5 && t_s < 4.0) {
      EXPECT_EQ(targets[i].stations.size(), 2U);
    }
    if (t_s > 0.5) {
      ASSERT_EQ(targets[i].estimate.solution, Solution::kOk) << t_s;
      EXPECT_LT(error_m(targets[i]), 0.3) << t_s;
    }
  }
  EXPECT_LT(longest_us, 500'000);
  EXPECT_EQ(fusion.health().counters.at("refused_future"), 0.0);
}

TEST(Fusion, StartsAnewWhenTheReplayIsStartedAgain) {
  const auto measurements = flight(5.0);
  Fusion fusion{FusionConfig{}};
  const auto first = targets_of(fusion, measurements);
  const auto second = targets_of(fusion, measurements);
  EXPECT_GT(second.size(), first.size() - 10);
  EXPECT_LT(error_m(second.back()), 0.02);
  EXPECT_EQ(fusion.health().counters.at("time_stepped_back"), 1.0);
}

// What the first replay taught about the stations is forgotten in the second one.
TEST(Fusion, EveryFurtherReplayGivesTheSameTargets) {
  for (const double noise : {2e-4, 3e-4, 1e-3}) {  // all larger than stated
    const auto measurements = flight(5.0, 1e-4, noise);
    Fusion fusion{FusionConfig{}};
    const auto first = targets_of(fusion, measurements);
    const auto second = targets_of(fusion, measurements);
    const auto third = targets_of(fusion, measurements);
    ASSERT_EQ(second.size(), third.size()) << noise;
    std::size_t compared = 0;
    for (std::size_t i = 0; i < second.size(); ++i) {
      ASSERT_EQ(second[i].utime_us, third[i].utime_us) << noise;
      ASSERT_EQ(second[i].estimate.solution, third[i].estimate.solution) << noise;
      if (second[i].estimate.solution != Solution::kOk) continue;
      EXPECT_EQ(second[i].estimate.position_ecef, third[i].estimate.position_ecef) << noise;
      EXPECT_EQ(second[i].estimate.covariance_ecef, third[i].estimate.covariance_ecef) << noise;
      ++compared;
    }
    EXPECT_GT(compared, 60U) << noise;
    // The first one differs by the bearings needed to detect the step. At ten sigmas these decide
    // where tracks begin, and the two are not comparable.
    if (noise > 3e-4) continue;
    const double was = first.back().estimate.covariance_ecef.trace();
    EXPECT_NEAR(second.back().estimate.covariance_ecef.trace() / was, 1.0, 0.1) << noise;
    EXPECT_LT(error_m(first.back()), 2.5 * std::sqrt(was)) << noise;
    EXPECT_LT(error_m(second.back()), 2.5 * std::sqrt(was)) << noise;
  }
}

class WorseThanStated : public testing::TestWithParam<double> {};

// Noise above the stated one neither splits an object in two nor spoils its position.
TEST_P(WorseThanStated, IsStillOneTarget) {
  Fusion fusion{FusionConfig{}};
  int located = 0, judged = 0;
  double normalised = 0.0;
  for (const FusedTarget& target : targets_of(fusion, flight(20.0, 1e-4, GetParam() * 1e-4))) {
    if (target.estimate.solution != Solution::kOk) continue;
    ++located;
    EXPECT_EQ(target.target_id, 1);
    EXPECT_LT(error_m(target), 0.3);
    if (target.utime_us < kStart + 5'000'000) continue;  // not learnt yet
    ++judged;
    normalised += std::pow(error_m(target), 2) / target.estimate.covariance_ecef.trace();
  }
  EXPECT_GT(located, 290);
  EXPECT_LT(normalised / judged, 2.0);
}

INSTANTIATE_TEST_SUITE_P(Times, WorseThanStated, testing::Values(2.0, 3.0));

// Bearings of the object that a station follows update its target even if they scatter. After a
// restart the same track_id is a new object.
TEST(Fusion, WhatARestartedStationFollowsIsNotWhatItFollowedBefore) {
  const auto set_aside = [](std::int64_t boot_after) {
    auto measurements = flight(2.0);
    for (BearingMeasurement& measurement : measurements) {
      measurement.track_id = 1;
      measurement.boot_id = 5;
      if (measurement.station != "a" || measurement.utime_us < kStart + 1'000'000) continue;
      measurement.boot_id = boot_after;
      measurement.sight.direction.azimuth_rad =
          wrap_two_pi(measurement.sight.direction.azimuth_rad + 0.2);
    }
    Fusion fusion{FusionConfig{}};
    for (const FusedTarget& target : targets_of(fusion, measurements)) {
      if (target.bearing_only || target.utime_us < kStart + 500'000) continue;
      EXPECT_LT(error_m(target), 0.05);
    }
    EXPECT_EQ(fusion.health().counters.at("stations_restarted"), boot_after == 5 ? 0.0 : 1.0);
    return fusion.tracks().counts().rejected;
  };
  EXPECT_GT(set_aside(5), 10);
  EXPECT_EQ(set_aside(6), 0);
}

TEST(Fusion, ANewTrackIsAnotherObject) {
  auto measurements = flight(2.0);
  for (BearingMeasurement& measurement : measurements) {
    const bool later = measurement.utime_us > kStart + 1'000'000;
    if (measurement.station != "a" || !later) continue;
    measurement.track_id = 2;
    measurement.sight.direction.azimuth_rad =
        wrap_two_pi(measurement.sight.direction.azimuth_rad + 0.2);
  }
  Fusion fusion{FusionConfig{}};
  int lines = 0;
  for (const FusedTarget& target : targets_of(fusion, measurements)) {
    if (target.utime_us < kStart + 500'000) continue;
    if (target.bearing_only) {
      EXPECT_EQ(target.bearing_only->station, "a");
      EXPECT_EQ(target.bearing_only->track_id, 2);
      EXPECT_GT(target.utime_us, kStart + 1'000'000);
      ++lines;
      continue;
    }
    ASSERT_EQ(target.estimate.solution, Solution::kOk);
    EXPECT_LT(error_m(target), 0.05);
    if (target.utime_us > kStart + 1'600'000) {
      ASSERT_EQ(target.stations.size(), 3U);
      EXPECT_EQ(target.stations[0].station, "b");
      EXPECT_TRUE(target.stations[0].used);
    }
  }
  EXPECT_GT(lines, 10);
}

// Late and interspersed bearings of no object do not move the target.
TEST(Fusion, ALateBearingOfAnotherObjectDoesNotDisturbTheTarget) {
  std::vector<BearingMeasurement> with_late;
  for (const BearingMeasurement& measurement : flight(2.0)) {
    with_late.push_back(measurement);
    if (measurement.utime_us < kStart + 1'000'000 || measurement.station != "a") continue;
    with_late.push_back(measurement);
    with_late.back().sight.direction.elevation_rad += 0.1;
    with_late.back().utime_us -= 100'000;
  }
  Fusion disturbed{FusionConfig{}};
  const auto targets = targets_of(disturbed, with_late);
  EXPECT_EQ(targets.back().target_id, 1);
  EXPECT_LT(error_m(targets.back()), 0.05);
}

TEST(Fusion, TwoStationsAtOnePlaceGiveNoPosition) {
  auto measurements = flight(3.0);
  std::erase_if(measurements, [](const BearingMeasurement& s) { return s.station > "b"; });
  for (BearingMeasurement& measurement : measurements) {
    const double t_s = static_cast<double>(measurement.utime_us - kStart) * 1e-6;
    measurement.sight = ray_to("a", square()[0], path(t_s), 1e-5).sight;
  }
  Fusion fusion{FusionConfig{}};
  for (const FusedTarget& target : targets_of(fusion, measurements)) {
    EXPECT_NE(target.estimate.solution, Solution::kOk);
  }
}

TEST(Fusion, OneStationAloneIsALineAndNoPosition) {
  auto measurements = flight(3.0);
  std::erase_if(measurements, [](const BearingMeasurement& s) { return s.station != "c"; });
  Fusion fusion{FusionConfig{}};
  const FusedTarget last = targets_of(fusion, measurements).back();
  EXPECT_EQ(last.estimate.solution, Solution::kBearingOnly);
  ASSERT_TRUE(last.bearing_only.has_value());
  EXPECT_EQ(last.bearing_only->station, "c");
  EXPECT_TRUE(std::isnan(last.estimate.position_ecef.x()));
}

// No other station sees its target: the others' target continues, next to its bearing-only track.
TEST(Fusion, WhoFollowsSomethingElseIsALineBesideTheTarget) {
  auto measurements = flight(3.0);
  for (BearingMeasurement& measurement : measurements) {
    measurement.track_id = 1;
    if (measurement.station != "d") continue;
    double& azimuth = measurement.sight.direction.azimuth_rad;
    azimuth = wrap_two_pi(azimuth + 0.7);
  }
  Fusion fusion{FusionConfig{}};
  int located = 0, lines = 0;
  for (const FusedTarget& target : targets_of(fusion, measurements)) {
    if (target.utime_us < kStart + 1'500'000) continue;
    located += target.estimate.solution == Solution::kOk ? 1 : 0;
    if (target.estimate.solution != Solution::kBearingOnly) continue;
    ++lines;
    ASSERT_TRUE(target.bearing_only);
    EXPECT_EQ(target.bearing_only->station, "d");
    EXPECT_NE(target.target_id, 1);
  }
  EXPECT_GE(located, 20);
  EXPECT_EQ(lines, located);
}

TEST(Fusion, TwoWhoFollowTwoObjectsAreTwoLinesAndNoPosition) {
  auto measurements = flight(3.0);
  std::erase_if(measurements,
                [](const BearingMeasurement& s) { return s.station == "b" || s.station == "d"; });
  for (BearingMeasurement& measurement : measurements) {
    measurement.track_id = 1;
    if (measurement.station == "c") measurement.sight.direction.elevation_rad = 1.4;
  }
  Fusion fusion{FusionConfig{}};
  std::map<std::string, int> lines;
  for (const FusedTarget& target : targets_of(fusion, measurements)) {
    EXPECT_NE(target.estimate.solution, Solution::kOk);
    if (target.bearing_only) ++lines[target.bearing_only->station];
  }
  EXPECT_GT(lines["a"], 30);
  EXPECT_GT(lines["c"], 30);
}

// The order of the station names does not matter.
TEST(Fusion, RenamingTheStationsChangesNothing) {
  const auto measurements = flight(3.0, 1e-4, 1e-4);
  auto renamed = measurements;
  for (BearingMeasurement& s : renamed)
    s.station = std::string(1, static_cast<char>('z' - s.station[0] + 'a'));
  Fusion first{FusionConfig{}}, second{FusionConfig{}};
  const auto a = targets_of(first, measurements), b = targets_of(second, renamed);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_EQ(a[i].estimate.solution, b[i].estimate.solution);
    if (a[i].estimate.solution != Solution::kOk) continue;
    if (a[i].utime_us < kStart + 1'000'000) continue;  // initiated by another pair
    EXPECT_LT((a[i].estimate.position_ecef - b[i].estimate.position_ecef).norm(), 1e-2);
  }
}
}  // namespace
}  // namespace ols::fusion
