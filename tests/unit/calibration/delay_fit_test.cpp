#include "calibration/delay_fit.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <random>

#include "geometry/angles.h"

namespace ols::calibration {
namespace {

using Eigen::Vector3d;
using Flight = std::function<Vector3d(double)>;

// A drone that flies figures of eight.
Vector3d eights(double time_s) {
  return {40.0 * std::sin(0.21 * time_s), 30.0 * std::sin(0.42 * time_s),
          70.0 + 8.0 * std::cos(0.3 * time_s)};
}

struct Site {
  std::vector<Vector3d> cameras{{-150.0, -100.0, 0.0}, {150.0, -100.0, 3.0}, {0.0, 180.0, 1.0}};
  double rate_hz = 12.0, duration_s = 90.0, noise_rad = 4e-4;
  LastingErrors errors{2e-3, radians(0.1), radians(0.05), 0.05};

  // Station 0 is late by this; the others by what their clocks are off.
  std::vector<TimedBearing> bearings(const Flight& flight, double late_s,
                                     std::mt19937_64& random) const {
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> phase(0.0, 1.0 / rate_hz);
    std::vector<TimedBearing> all;
    for (std::size_t i = 0; i < cameras.size(); ++i) {
      const double off_s = i == 0 ? late_s : errors.clock_sd_s * normal(random);
      const Vector3d turn(errors.tilt_sd_rad * normal(random), errors.tilt_sd_rad * normal(random),
                          errors.heading_sd_rad * normal(random));
      const Vector3d shift =
          errors.position_sd_m * Vector3d(normal(random), normal(random), normal(random));
      for (double t = phase(random); t < duration_s; t += 1.0 / rate_hz) {
        TimedBearing one;
        one.station = i;
        one.time_s = t + off_s;
        one.camera_m = cameras[i] + shift;
        one.direction = (flight(t) - cameras[i]).normalized();
        one.direction += turn.cross(one.direction);
        one.direction += noise_rad * Vector3d(normal(random), normal(random), normal(random));
        one.direction.normalize();
        one.sd_rad = noise_rad;
        all.push_back(one);
      }
    }
    return all;
  }
  std::vector<LastingErrors> stated() const { return std::vector(cameras.size(), errors); }
};

TEST(DelayFit, TheDelayIsFoundAsExactlyAsStated) {
  Site three, two;
  two.cameras.resize(2);
  for (const Site& site : {three, two}) {
    SCOPED_TRACE(site.cameras.size());
    double square_s2 = 0.0, told_s2 = 0.0;
    for (std::uint64_t seed = 1; seed <= 30; ++seed) {
      SCOPED_TRACE(seed);
      std::mt19937_64 random(seed);
      const double late_s = std::normal_distribution<double>(0.0, 0.2)(random);
      const DelayFit fit = fit_delay(site.bearings(eights, late_s, random), site.stated(), 0);
      ASSERT_TRUE(fit.late_s);
      EXPECT_NEAR(fit.late_s->value, late_s, 0.015);
      EXPECT_NEAR(fit.misfit, 1.0, 0.3);
      square_s2 += std::pow(fit.late_s->value - late_s, 2);
      told_s2 += std::pow(fit.late_s->sd, 2);
    }
    const double ratio = std::sqrt(told_s2 / square_s2);
    std::printf("[ %zu stations: RMS error %.1f ms, told over actual %.2f ]\n", site.cameras.size(),
                1e3 * std::sqrt(square_s2 / 30.0), ratio);
    EXPECT_GT(ratio, 0.7);
    EXPECT_LT(ratio, 1.5);
  }
}

// Network cameras are late by up to 2.5 s.
TEST(DelayFit, ALongDelayIsFound) {
  const Site site;
  for (const double late_s : {2.0, 2.5, -2.0}) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      SCOPED_TRACE(testing::Message() << late_s << " s, seed " << seed);
      std::mt19937_64 random(seed);
      const DelayFit fit = fit_delay(site.bearings(eights, late_s, random), site.stated(), 0);
      ASSERT_TRUE(fit.late_s);
      EXPECT_NEAR(fit.late_s->value, late_s, 0.015);
    }
  }
}

// Far beyond what is expected, the fit wanders for many rounds, and would end anywhere.
TEST(DelayFit, AHugeDelayIsFoundOrRefused) {
  const Site site;
  for (const double late_s : {8.0, -8.0, 9.0}) {
    SCOPED_TRACE(late_s);
    std::mt19937_64 random(1);
    const DelayFit fit = fit_delay(site.bearings(eights, late_s, random), site.stated(), 0);
    if (fit.late_s) EXPECT_NEAR(fit.late_s->value, late_s, 0.015);
  }
}

// A wrong time of 1970, and the stations of other days, would take hours and gigabytes.
TEST(DelayFit, GapsAndStationsOfOtherDaysTakeNoTime) {
  const Site site;
  std::mt19937_64 random(1);
  const auto good = site.bearings(eights, 0.2, random);
  auto stations = site.stated();
  auto all = good;
  for (const std::size_t station : {0U, 1U}) {
    all.push_back(good.front());
    all.back().station = station;
    all.back().time_s = -1.7e9;
  }
  for (int other = 0; other < 2000; ++other) {
    all.push_back(good.front());
    all.back().station = stations.size();
    all.back().time_s = 1e5 + other;
    stations.push_back(site.errors);
  }
  const DelayFit alone = fit_delay(good, site.stated(), 0), fit = fit_delay(all, stations, 0);
  ASSERT_TRUE(alone.late_s && fit.late_s);
  EXPECT_EQ(fit.late_s->value, alone.late_s->value);
  EXPECT_EQ(fit.late_s->sd, alone.late_s->sd);
}

TEST(DelayFit, AnObjectThatDoesNotMoveShowsNoDelay) {
  const Site site;
  std::mt19937_64 random(1);
  const auto hovers = [](double /*time_s*/) { return Vector3d(10.0, 20.0, 60.0); };
  const DelayFit fit = fit_delay(site.bearings(hovers, 0.2, random), site.stated(), 0);
  EXPECT_FALSE(fit.late_s);
  EXPECT_GT(fit.seconds, 80U);
}

TEST(DelayFit, WithoutAnotherStationOrWithSeveralObjectsThereIsNone) {
  const Site site;
  std::mt19937_64 random(1);
  auto all = site.bearings(eights, 0.2, random);
  auto alone = all;
  std::erase_if(alone, [](const TimedBearing& one) { return one.station != 0; });
  EXPECT_FALSE(fit_delay(alone, site.stated(), 0).late_s);
  EXPECT_FALSE(fit_delay({}, site.stated(), 0).late_s);
  for (TimedBearing one : site.bearings(eights, 0.2, random)) {
    one.track_id = 7;
    if (one.station == 1) all.push_back(one);
  }
  const DelayFit fit = fit_delay(all, site.stated(), 0);
  EXPECT_FALSE(fit.late_s);
  EXPECT_GT(fit.several, 80U);
}

// Some seconds in which a tracker followed something else.
TEST(DelayFit, AFewWrongSecondsDoNoHarm) {
  const Site site;
  std::mt19937_64 random(3);
  auto all = site.bearings(eights, 0.1, random);
  for (TimedBearing& one : all) {
    if (one.station == 1 && one.time_s > 30.0 && one.time_s < 35.0)
      one.direction = (one.direction + Vector3d(0.05, 0.0, 0.03)).normalized();
  }
  const DelayFit fit = fit_delay(all, site.stated(), 0);
  ASSERT_TRUE(fit.late_s);
  EXPECT_NEAR(fit.late_s->value, 0.1, 0.015);
}

}  // namespace
}  // namespace ols::calibration
