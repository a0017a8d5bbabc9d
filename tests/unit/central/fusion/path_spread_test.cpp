#include "central/fusion/path_spread.h"

#include <gtest/gtest.h>

#include "tests/unit/central/flight.h"

namespace ols::fusion {
namespace {

using test::kStart;

// East and west in turn, at 10 m/s: it turns round every `turns_s`.
Eigen::Vector3d there_and_back(double t_s, double turns_s) {
  const double phase = std::fmod(t_s, 2.0 * turns_s);
  return {10.0 * (phase < turns_s ? phase : 2.0 * turns_s - phase), 150.0, 120.0};
}

PathSpread spread_after(double seconds, double turns_s) {
  TrackFilter filter(
      {}, kStart,
      {test::site().to_ecef(there_and_back(0.0, turns_s)), Eigen::Vector3d::Zero(), 5.0, 10.0});
  BiasModel errors;
  PathSpread spread;
  for (int i = 0; i < static_cast<int>(60.0 * seconds); ++i) {
    const double t_s = i / 60.0;
    const std::int64_t utime_us = kStart + std::llround(1e6 * t_s);
    const Ray ray = test::ray_to(std::string(1, static_cast<char>('a' + i % 4)),
                                 test::square()[static_cast<std::size_t>(i % 4)],
                                 there_and_back(t_s, turns_s), 1e-5);
    test::feed(filter, test::measurement_of(ray, utime_us), errors);
    spread.note(filter, utime_us);
  }
  return spread;
}

TEST(PathSpread, IsThatOfTheFilterUntilPredictionsHaveComeTrue) {
  const PathSpread none = spread_after(0.9, 100.0);
  for (const double lead_s : {0.0, 1.0, 3.0, 20.0}) EXPECT_NEAR(none.factor(lead_s), 1.0, 1e-12);
}

TEST(PathSpread, ShrinksForATargetThatFliesStraight) {
  const PathSpread straight = spread_after(20.0, 100.0);
  EXPECT_EQ(straight.factor(0.0), 1.0);
  EXPECT_LT(straight.factor(2.0), 0.15);
  EXPECT_GT(straight.factor(2.0), 1.0 / 3.0 / 11.0);  // it may yet manoeuvre
  EXPECT_NEAR(straight.factor(0.5), 0.5 * (1.0 + straight.factor(1.0)), 1e-12);
  EXPECT_EQ(straight.factor(8.0), straight.factor(12.0));
}

TEST(PathSpread, StaysWideForATargetThatTurnsRound) {
  const PathSpread turning = spread_after(20.0, 3.0);
  EXPECT_GT(turning.factor(2.0), 0.3);
  EXPECT_GT(turning.factor(4.0), 3.0 * spread_after(20.0, 100.0).factor(4.0));
}

}  // namespace
}  // namespace ols::fusion
