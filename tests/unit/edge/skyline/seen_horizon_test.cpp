#include "edge/skyline/seen_horizon.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "geometry/angles.h"

namespace ols::skyline {
namespace {

constexpr double kAzimuth_rad = radians(40.01);

std::vector<SkylinePoint> at(double elevation_rad, double sd_rad = 1e-4) {
  return {{{kAzimuth_rad, elevation_rad}, sd_rad}};
}

TEST(SeenHorizonTest, TheMeanOfSeveralPicturesHasTheVarianceOfAMean) {
  constexpr int kRuns = 1500;
  constexpr double kNoise_rad = 1e-4;
  std::mt19937 generator(1);
  std::normal_distribution<double> noise(0.0, kNoise_rad);
  for (const int pictures : {1, 2, SeenHorizon::kMost}) {
    double nees = 0.0, variance_rad2 = 0.0;
    SeenHorizon seen;
    for (int run = 0; run < kRuns; ++run) {
      seen.clear();
      for (int i = 0; i < pictures; ++i) seen.add(at(noise(generator), kNoise_rad), i, 0.0);
      const SeenPlace place = seen.places().at(0);
      variance_rad2 += place.variance_rad2 / kRuns;
      nees += std::pow(place.direction.elevation_rad, 2) / place.variance_rad2 / kRuns;
    }
    // The scatter of few pictures can only add to what they state.
    EXPECT_GE(variance_rad2, 0.999 * kNoise_rad * kNoise_rad / pictures) << pictures;
    EXPECT_LT(variance_rad2, 1.4 * kNoise_rad * kNoise_rad / pictures) << pictures;
    EXPECT_GT(nees, 0.6) << pictures;
    EXPECT_LT(nees, 1.1) << pictures;
  }
}

TEST(SeenHorizonTest, WhatIsSeenAnewSoonReplacesWhatWasSeen) {
  SeenHorizon seen;
  for (int i = 0; i < 1000; ++i) seen.add(at(0.0), i, 0.0);
  for (int i = 0; i < 15; ++i) seen.add(at(1e-3), 1000 + i, 0.0);
  EXPECT_NEAR(seen.places().at(0).direction.elevation_rad, 1e-3, 0.05e-3);
}

TEST(SeenHorizonTest, WhatIsNotSeenAgainIsForgotten) {
  SeenHorizon seen;
  seen.add(at(0.01), 100.0, 0.0);
  const std::vector<SkylinePoint> elsewhere{{{radians(90.0), 0.02}, 1e-4}};
  seen.add(elsewhere, 100.0 + SeenHorizon::kMemory_s, 0.0);
  EXPECT_EQ(seen.places().size(), 2U);
  seen.add(elsewhere, 101.0 + SeenHorizon::kMemory_s, 0.0);
  EXPECT_EQ(seen.places().size(), 1U);
  seen.add(at(0.03), 102.0 + SeenHorizon::kMemory_s, 0.0);
  EXPECT_EQ(seen.places().at(0).direction.elevation_rad, 0.03) << "the old one has no share in it";
}

TEST(SeenHorizonTest, KeepsWhatTheStationStatesOfItsAzimuths) {
  SeenHorizon seen;
  seen.add(at(0.0), 1.0, 0.3);
  seen.add(at(0.0), 2.0, 0.1);
  EXPECT_NEAR(seen.places().at(0).azimuth_variance_rad2, 0.5 * (0.09 + 0.01), 1e-12);
}

}  // namespace
}  // namespace ols::skyline
