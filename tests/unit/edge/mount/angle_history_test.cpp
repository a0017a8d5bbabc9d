#include "edge/mount/angle_history.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <random>

#include "geometry/angles.h"

namespace ols::mount {
namespace {

AngleHistory ramp() {  // 0.4 rad/s pan, -0.1 rad/s tilt, a sample every 25 ms from 1.0 to 1.25 s
  AngleHistory history{AngleHistory::Config{}};
  for (int i = 0; i <= 10; ++i) {
    const double t = 1.0 + 0.025 * i;
    EXPECT_TRUE(history.add({t, 0.0005, {0.4 * t, -0.1 * t}, {}}));
  }
  return history;
}

TEST(AngleHistory, InterpolatesAndExtrapolates) {
  const AngleHistory history = ramp();
  for (const double t : {1.0, 1.01, 1.2499, 1.25, 1.3, 1.4}) {
    const auto at = history.at(t);
    ASSERT_TRUE(at) << t;
    EXPECT_NEAR(at->angles.pan_rad, 0.4 * t, 1e-12);
    EXPECT_NEAR(at->angles.tilt_rad, -0.1 * t, 1e-12);
    EXPECT_NEAR(at->rate.pan_rad, 0.4, 1e-9);
    EXPECT_EQ(at->interpolated, t <= 1.25);
  }
}

TEST(AngleHistory, SaysNothingOutsideOfWhatItKnows) {
  AngleHistory history = ramp();
  EXPECT_FALSE(history.at(0.999));
  EXPECT_FALSE(history.at(1.401));
  EXPECT_FALSE(history.at(std::nan("")));
  EXPECT_TRUE(history.add({2.0, 0.0, {}, {}}));  // after a gap
  EXPECT_FALSE(history.at(1.5));
  EXPECT_FALSE(history.at(2.0));
  history.clear();
  EXPECT_FALSE(history.newest());
  EXPECT_TRUE(history.add({3.0, 0.0, {}, {}}));
  EXPECT_FALSE(history.at(3.0));  // one sample tells no rate
}

TEST(AngleHistory, RefusesWhatIsOutOfOrderOrNotFinite) {
  AngleHistory history = ramp();
  EXPECT_FALSE(history.add({1.25, 0.0, {}, {}}));
  EXPECT_FALSE(history.add({1.1, 0.0, {}, {}}));
  EXPECT_FALSE(history.add({2.0, 0.0, {std::nan(""), 0.0}, {}}));
  EXPECT_FALSE(history.add({std::numeric_limits<double>::infinity(), 0.0, {}, {}}));
  EXPECT_DOUBLE_EQ(history.newest()->time_s, 1.25);
}

TEST(AngleHistory, ForgetsWhatIsOlderThanItsSpan) {
  AngleHistory history{AngleHistory::Config{}};
  for (int i = 0; i < 1000; ++i) history.add({0.02 * i, 0.0, {}, {}});
  EXPECT_FALSE(history.at(0.02 * 999 - 5.1));
  EXPECT_TRUE(history.at(0.02 * 999 - 4.9));
}

// Encoder steps and time errors drawn as claimed: the normalised error squared is that of two
// degrees of freedom, between samples and beyond the last one.
TEST(AngleHistory, CovarianceIsHonest) {
  AngleHistory::Config config;
  config.acceleration_sd_rad_s2 = 0.0;
  config.acceleration_max_rad_s2 = 0.0;
  std::mt19937_64 random(11);
  std::normal_distribution<double> gauss;
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (const double when : {0.013, 0.045}) {
    double nees = 0.0;
    const int runs = 4000;
    for (int run = 0; run < runs; ++run) {
      AngleHistory history(config);
      const Eigen::Vector2d rate(0.3 * gauss(random), 0.2 * gauss(random));
      const Eigen::Vector2d start(uniform(random), uniform(random));
      for (int i = 0; i < 2; ++i) {
        const double sd_s = 0.0005 * (1 + i);
        const double tilt_sd_s = 2.0 * sd_s;
        const double pan = start.x() + rate.x() * (0.025 * i + sd_s * gauss(random));
        const double tilt = start.y() + rate.y() * (0.025 * i + tilt_sd_s * gauss(random));
        const auto counted = [&config](double angle) {
          return std::round(angle / config.step_rad) * config.step_rad;
        };
        history.add({0.025 * i, sd_s, {counted(pan), counted(tilt)}, tilt_sd_s});
      }
      const auto at = history.at(when);
      ASSERT_TRUE(at);
      const Eigen::Vector2d error =
          Eigen::Vector2d(at->angles.pan_rad, at->angles.tilt_rad) - (start + rate * when);
      nees += error.dot(at->covariance.inverse() * error) / 2.0;
    }
    EXPECT_NEAR(nees / runs, 1.0, 0.08) << when;
  }
}

// 5 deg/s, a sample every tenth of a second that is wrong by up to 0.1 deg.
TEST(AngleHistory, BeyondTheNewestSampleTheOrderedRateSaysHowMuchMayHaveBegun) {
  struct Case {
    std::optional<PanTilt> ordered_change;
    double shared_time_sd_s, sd_deg;  // 0.2 s after the newest sample
  };
  const double noise_deg = 0.05 * std::sqrt(3.0 * 3.0 + 2.0 * 2.0);
  const double unknown_deg = degrees(0.5 * 1.0 * 0.5 * 0.2 * 0.2);
  for (const Case& c :
       {Case{PanTilt{}, 0.0, noise_deg}, Case{PanTilt{}, 0.1, std::hypot(noise_deg, 0.5)},
        Case{PanTilt{0.1, 0.0}, 0.0, std::hypot(noise_deg, degrees(0.02 / std::sqrt(12.0)))},
        Case{std::nullopt, 0.0, std::hypot(noise_deg, unknown_deg)}}) {
    AngleHistory history({.max_extrapolation_s = 0.3, .acceleration_sd_rad_s2 = 1e-6});
    for (int i = 0; i < 20; ++i) {
      const double time_s = 0.1 * i;
      history.add({.time_s = time_s,
                   .angles = {radians(5.0 * time_s), 0.0},
                   .doubt = {radians(0.05), 0.0},
                   .ordered_change = c.ordered_change,
                   .shared_time_sd_s = c.shared_time_sd_s});
    }
    const double variance_rad2 = history.at(2.1).value().covariance(0, 0);
    EXPECT_NEAR(degrees(std::sqrt(variance_rad2)), c.sd_deg, 1e-3);
  }
}

// It may be that of the place, at all instants: between two samples it does not average out.
TEST(AngleHistory, TheErrorOfThePlaceLasts) {
  AngleHistory history({});
  for (int i = 0; i < 3; ++i) history.add({.time_s = 0.1 * i, .place_sd = {2e-3, 3e-3}});
  const AngleAt at = history.at(0.15).value();
  EXPECT_NEAR(at.lasting_covariance(0, 0), 4e-6, 1e-12);
  EXPECT_NEAR(at.lasting_covariance(1, 1), 9e-6, 1e-12);
  EXPECT_GT(at.covariance(0, 0), 0.49 * 4e-6) << "or it changes from sample to sample";
}

// Without an order to change the rate.
TEST(AngleHistory, AnAccelerationThatTheSamplesShowCountsBeyondTheNewest) {
  AngleHistory history({.max_extrapolation_s = 0.3, .acceleration_sd_rad_s2 = 1e-6});
  constexpr double kAcceleration = 0.5;
  for (int i = 0; i < 20; ++i) {
    const double time_s = 0.1 * i;
    history.add({.time_s = time_s,
                 .angles = {0.5 * kAcceleration * time_s * time_s, 0.0},
                 .ordered_change = PanTilt{}});
  }
  const double error_rad = 0.5 * kAcceleration * 0.2 * (0.2 + 0.1);  // 0.2 s after the newest
  EXPECT_NEAR(std::sqrt(history.at(2.1).value().covariance(0, 0)), error_rad, 0.1 * error_rad);
}

}  // namespace
}  // namespace ols::mount
