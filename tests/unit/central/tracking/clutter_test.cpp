#include "central/tracking/clutter.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/unit/central/scene.h"

namespace ols::fusion {
namespace {

constexpr std::int64_t kClutterStart = 1'700'000'000'000'000;

BearingMeasurement tracklet(const std::string& station, std::int64_t id, double time_s,
                            double elevation_rad, double rate_rad_s) {
  BearingMeasurement m;
  m.station = station;
  m.utime_us = kClutterStart + static_cast<std::int64_t>(time_s * 1e6);
  m.is_tracklet = true;
  m.track_id = id;
  m.sight.direction.elevation_rad = elevation_rad;
  m.sight.covariance_white = 1e-8 * Eigen::Matrix2d::Identity();
  m.sighted.rate_rad_s = {0.0, rate_rad_s};
  m.sighted.rate_covariance = 1e-6 * Eigen::Matrix2d::Identity();
  return m;
}

// A minute of two stations: every two seconds one for a second, in 0.6 rad.
Clutter clutter_of_a_minute(bool of_targets = false) {
  Clutter clutter;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int i = 0; i < 30; ++i) {
    for (const char* station : {"a", "b"}) {
      const double elevation = 0.3 * uniform(random), rate = 0.1 * uniform(random);
      for (int k = 0; k <= 10; ++k)
        clutter.unclaimed(
            tracklet(station, i, 2.0 * i + 0.1 * k, elevation + 0.1 * k * rate, rate));
      if (of_targets) clutter.claimed(tracklet(station, i, 2.0 * i + 1.05, elevation, rate));
    }
  }
  return clutter;
}

// Of a day: 2 x 0.5 a second x half of the time x 1.4e-3 of 0.6 rad x 2.8e-3 of 0.145 rad/s x
// exp(-2).
TEST(Clutter, PredictsHowManyPairsAgreeByChance) {
  const double a_day = clutter_of_a_minute().pairs_a_day("a", "b", 1.0);
  EXPECT_GT(a_day, 0.5 * 0.27);
  EXPECT_LT(a_day, 2.0 * 0.27);
}

TEST(Clutter, AgreesTheRarerTheLonger) {
  const Clutter clutter = clutter_of_a_minute();
  EXPECT_LT(clutter.pairs_a_day("a", "b", 3.0), 0.05 * clutter.pairs_a_day("a", "b", 1.0));
}

TEST(Clutter, CountsNothingThatATargetTook) {
  EXPECT_EQ(clutter_of_a_minute(true).pairs_a_day("a", "b", 1.0), 0.0);
}

TEST(Clutter, OfASitePublishesAtMostSoManyOfEachPair) {
  const Clutter clutter = clutter_of_a_minute();
  const double a_day = clutter.pairs_a_day("a", "b", 1.0);
  EXPECT_DOUBLE_EQ(clutter.published_a_day(1.0, 100.0), a_day);
  EXPECT_DOUBLE_EQ(clutter.published_a_day(1.0, 0.5 * a_day), 0.5 * a_day);
}

TEST(Clutter, IsNoneOfAnUnknownStation) {
  const Clutter clutter = clutter_of_a_minute();
  EXPECT_EQ(clutter.pairs_a_day("a", "c", 1.0), 0.0);
  EXPECT_EQ(clutter.pairs_of_stations(), 1);
}

}  // namespace
}  // namespace ols::fusion
