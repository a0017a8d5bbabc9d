// How well the angles at an exposure are known, against the unit's true angles: polls every 25 ms
// at 38400 baud, replies that come up to 3 ms earlier or later than usual.
#include <gtest/gtest.h>

#include <cstdio>

#include "tests/unit/edge/ptu/published_angles.h"

namespace ols::ptu {
namespace {

struct Motion {
  const char* name;
  double speed_deg_s;    // greatest
  double amplitude_deg;  // 0: constant speed
  double allowed_rms_deg;
};

class ExposureAccuracy : public testing::TestWithParam<std::tuple<Motion, double>> {};

// Angle and rate, back and forth over at most 120 degrees.
std::pair<double, double> pan_at(const Motion& m, double t) {
  if (m.amplitude_deg > 0.0) {
    const double omega = m.speed_deg_s / m.amplitude_deg;
    return {radians(m.amplitude_deg * std::sin(omega * t)),
            radians(m.speed_deg_s * std::cos(omega * t))};
  }
  const double leg_s = 120.0 / m.speed_deg_s;
  const double phase = std::fmod(t, 2.0 * leg_s);
  const bool forth = phase < leg_s;
  const double way = m.speed_deg_s * (forth ? phase : 2.0 * leg_s - phase);
  return {radians(way - 60.0), radians(forth ? m.speed_deg_s : -m.speed_deg_s)};
}

TEST_P(ExposureAccuracy, IsAsGoodAsItSays) {
  const auto& [motion, delay_s] = GetParam();
  PtuConfig config = quick_driver(38400);
  config.acceleration_rad_s2 = radians(60.0);
  sim::PtuUnitConfig unit = quick_unit(38400);
  unit.reply_delay_s = delay_s;
  unit.reply_jitter_s = 0.003;
  ClosedLoop loop(config, unit);
  ASSERT_TRUE(loop.start());
  PublishedAngles angles(config.history);
  const double begin_s = loop.time_s;
  const auto follow = [&, &motion = motion](PublishedAngles* measured) {
    const auto [pan, rate] = pan_at(motion, loop.time_s - begin_s);
    loop.driver.set_goal(loop.goal({pan, 0.3 * radians(10.0) * std::sin(pan)}, {rate, 0.0}));
    if (measured != nullptr) measured->step(loop);
  };
  loop.run(6.0, [&] { follow(nullptr); });  // up to speed
  loop.driver.take_samples();
  loop.run(300.0, [&] { follow(&angles); });
  std::printf("%-22s %.0f ms +- 3 ms: %d exposures, rms %.4f deg, NEES %.2f, worst %.2f sigmas\n",
              motion.name, 1e3 * delay_s, angles.published, angles.rms_deg(), angles.pan_nees(),
              angles.worst_sigmas);
  EXPECT_GT(angles.published, 4400);
  EXPECT_LE(angles.rms_deg(), motion.allowed_rms_deg);
  EXPECT_GT(angles.pan_nees(), 0.7);
  EXPECT_LT(angles.pan_nees(), 1.4);
  EXPECT_LT(angles.nees(), 1.4);
}

INSTANTIATE_TEST_SUITE_P(
    Motions, ExposureAccuracy,
    testing::Combine(testing::Values(Motion{"constant 20 deg/s", 20.0, 0.0, 0.02},
                                     Motion{"sinusoid 20 deg/s", 20.0, 40.0, 0.02},
                                     Motion{"constant 2 deg/s", 2.0, 0.0, 0.004},
                                     Motion{"sinusoid 2 deg/s", 2.0, 4.0, 0.004}),
                     testing::Values(0.001, 0.004)),
    [](const auto& test) {
      std::string name = std::get<0>(test.param).name;
      for (char& c : name) c = std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
      return name + (std::get<1>(test.param) < 0.002 ? "_clipped" : "_late");
    });

}  // namespace
}  // namespace ols::ptu
