#include "calibration/light_fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

namespace ols::calibration {
namespace {

struct Filmed {
  BlinkingLight light;
  double late_s = 0.183;
  double interval_s = 1.0 / 25.0003, exposure_s = 0.008;
  double jitter_s = 0.0;  // of the stamps
  double noise = 2.0, on = 60.0;
  double for_s = 60.0;
};

std::vector<LightSample> film(const Filmed& how, unsigned seed) {
  constexpr double kBegin_s = 1'780'000'000.0;
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> phase(0.0, how.interval_s);
  std::vector<LightSample> samples;
  for (double t = kBegin_s + phase(random); t < kBegin_s + how.for_s; t += how.interval_s) {
    constexpr int kParts = 40;
    double lit = 0.0;
    for (int i = 0; i < kParts; ++i) {
      const double at = t + how.exposure_s * ((i + 0.5) / kParts - 0.5);
      const double in = at - std::floor(at / how.light.period_s) * how.light.period_s;
      lit += (in < how.light.lit_s ? 1.0 : 0.0) / kParts;
    }
    samples.push_back({t + how.late_s + how.jitter_s * normal(random),
                       40.0 + how.on * lit + how.noise * normal(random)});
  }
  return samples;
}

struct Errors {
  double rms_s = 0.0, rms_sigmas = 0.0;
  int found = 0;
};
Errors errors_of(const Filmed& how, int seeds) {
  Errors errors;
  for (int seed = 1; seed <= seeds; ++seed) {
    const auto fit = fit_light(film(how, static_cast<unsigned>(seed)), how.light);
    if (!fit.late_s) continue;
    const double off_s = std::remainder(fit.late_s->value - how.late_s, how.light.period_s);
    errors.rms_s += off_s * off_s;
    errors.rms_sigmas += std::pow(off_s / fit.late_s->sd, 2);
    ++errors.found;
  }
  errors.rms_s = std::sqrt(errors.rms_s / errors.found);
  errors.rms_sigmas = std::sqrt(errors.rms_sigmas / errors.found);
  std::printf("found %d, RMS %.2f ms, told over actual %.2f\n", errors.found, 1e3 * errors.rms_s,
              1.0 / errors.rms_sigmas);
  return errors;
}

const BlinkingLight kSeventh{.period_s = 1.0 / 7.0, .lit_s = 0.05};

TEST(LightFit, AnAwkwardPeriodTellsTheDelayToAMillisecond) {
  const Errors errors = errors_of({.light = kSeventh, .late_s = 0.04}, 16);
  EXPECT_EQ(errors.found, 16);
  EXPECT_LT(errors.rms_s, 0.001);
  EXPECT_GT(errors.rms_sigmas, 0.6);
  EXPECT_LT(errors.rms_sigmas, 1.6);
}

TEST(LightFit, JitterOfTheTimesIsPartOfTheUncertainty) {
  const Errors errors = errors_of({.light = kSeventh, .late_s = -0.02, .jitter_s = 0.004}, 16);
  EXPECT_EQ(errors.found, 16);
  EXPECT_LT(errors.rms_s, 0.002);
  EXPECT_GT(errors.rms_sigmas, 0.6);
  EXPECT_LT(errors.rms_sigmas, 1.6);
}

// 25 pictures a second see a light of 1 Hz at the same phases again and again.
TEST(LightFit, APeriodThatIsAMultipleOfTheIntervalTellsLess) {
  const Errors errors = errors_of({.interval_s = 0.04, .exposure_s = 0.001}, 16);
  EXPECT_EQ(errors.found, 16);
  EXPECT_GT(errors.rms_s, 0.003);
  EXPECT_LT(errors.rms_s, 0.012);
  EXPECT_GT(errors.rms_sigmas, 0.6);
  EXPECT_LT(errors.rms_sigmas, 1.6);
}

TEST(LightFit, WhatDoesNotBlinkHasNoDelay) {
  Filmed dark;
  dark.on = 0.0;
  EXPECT_FALSE(fit_light(film(dark, 3), dark.light).late_s);
  Filmed another;  // a lamp with another period
  another.light.period_s = 0.73;
  EXPECT_FALSE(fit_light(film(another, 3), BlinkingLight{}).late_s);
}

TEST(LightFit, RefusesImpossibleLights) {
  const auto samples = film({}, 1);
  for (const BlinkingLight& light : {BlinkingLight{0.0, 0.1}, {1.0, 1.0}, {1.0, 0.0}}) {
    EXPECT_THROW(fit_light(samples, light), std::invalid_argument);
  }
  EXPECT_THROW(fit_light({samples.begin(), samples.begin() + 49}, {}), std::invalid_argument);
}

}  // namespace
}  // namespace ols::calibration
