#include "edge/mount/driven/position_intake.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace ols::mount {
namespace {

constexpr PanTilt kRate{radians(5.0), radians(-1.0)};

struct Sds {
  double stated_s, actual_s;
};

// Of the instants of positions in motion. `fixed_s`: the same for the way to the mount and back.
Sds instants(double fixed_s, double random_s) {
  constexpr std::uint64_t kSeed = 7;
  std::mt19937_64 random(kSeed);
  std::uniform_real_distribution<double> extra_s(0.0, random_s);
  PositionIntake intake({.delay_s = 0.0, .delay_sd_s = 0.003, .sd_rad = radians(0.01)});
  intake.ordered(kRate, 0.0);
  double stated_s2 = 0.0, actual_s2 = 0.0;
  int counted = 0;
  for (double sent_s = 1.0; sent_s < 60.0; sent_s += 0.1) {
    const double at_s = sent_s + fixed_s + extra_s(random);
    intake.add({kRate.pan_rad * at_s, kRate.tilt_rad * at_s}, sent_s,
               at_s + fixed_s + extra_s(random), kRate.pan_rad);
    for (const AngleSample& sample : intake.take()) {
      EXPECT_EQ(sample.shared_time_sd_s, 0.003);
      if (sent_s < 20.0) continue;
      stated_s2 += sample.time_sd_s * sample.time_sd_s;
      actual_s2 += std::pow(sample.time_s - at_s, 2);
      ++counted;
    }
  }
  return {std::sqrt(stated_s2 / counted), std::sqrt(actual_s2 / counted)};
}

TEST(PositionIntake, LearnsHowMuchTheInstantsScatterInTheRoundTrip) {
  const Sds symmetrical = instants(0.05, 0.0);
  EXPECT_LT(symmetrical.stated_s, 0.004);
  for (const double random_s : {0.025, 0.05}) {
    const Sds of = instants(0.02, random_s);
    EXPECT_NEAR(of.stated_s / of.actual_s, 1.0, 0.3) << random_s;
  }
}

TEST(PositionIntake, SaysHowMuchTheOrderedRateHasChanged) {
  PositionIntake intake({});
  const auto change = [&](double now_s) {
    intake.add({0.01 * now_s, 0.0}, now_s - 0.02, now_s, 0.0);
    return intake.take().at(0).ordered_change;
  };
  EXPECT_FALSE(change(1.0));  // what it was ordered before is not known
  intake.ordered(PanTilt{}, 1.0);
  EXPECT_FALSE(change(1.8));  // nor shortly before the position before this one
  intake.ordered(PanTilt{0.1, -0.2}, 2.0);
  ASSERT_TRUE(change(2.1));
  EXPECT_NEAR(change(2.2)->tilt_rad, 0.2, 1e-12);
  EXPECT_NEAR(change(3.0)->pan_rad, 0.1, 1e-12);  // the position before is old
  EXPECT_EQ(change(3.1)->pan_rad, 0.0);
  intake.ordered({}, 3.1);  // to a place
  EXPECT_FALSE(change(3.2));
}

TEST(PositionIntake, AnOldPositionInMotionIsNotUsed) {
  PositionIntake intake({.delay_s = 0.0, .delay_sd_s = 0.001, .sd_rad = radians(0.1)});
  const double rate = radians(10.0);
  double worst_s = 0.0;
  for (int i = 0; i < 100; ++i) {  // asked ten times a second, renewed every 0.3 s
    const double t = 0.1 * i, renewed_s = 0.3 * std::floor((t + 1e-9) / 0.3);
    intake.add({rate * renewed_s, 0.0}, t - 0.01, t + 0.01, rate);
    for (const AngleSample& sample : intake.take())
      worst_s = std::max(worst_s, std::abs(sample.time_s - sample.angles.pan_rad / rate));
  }
  EXPECT_LT(worst_s, 0.11);
  EXPECT_NEAR(intake.interval_s(), 0.3, 0.1);
}

}  // namespace
}  // namespace ols::mount
