#include "calibration/mount_fit.h"

#include <gtest/gtest.h>

#include <random>

#include "geometry/angles.h"

namespace ols::calibration {
namespace {

struct Mount {
  double gain, backlash_rad, delay_s;
};

// Steps up and down, then passes in both directions.
std::vector<MountReading> readings_of(const Mount& m, std::uint64_t seed, int strays = 0) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> position(0.0, radians(0.02));
  std::vector<MountReading> all;
  const auto add = [&](double reported_rad, double rate_rad_s, int approach) {
    MountReading r{reported_rad, rate_rad_s, approach, 0.0, rate_rad_s != 0.0};
    r.seen_rad = 0.3 + m.gain * (reported_rad + m.delay_s * rate_rad_s) +
                 0.5 * m.backlash_rad * approach + position(random);
    if (static_cast<int>(all.size()) < strays) r.seen_rad += 0.1;
    all.push_back(r);
  };
  for (int side : {1, -1}) {
    for (int i = -4; i <= 4; ++i) add(radians(2.5 * side * i), 0.0, side);
    for (int i = -8; i <= 8; ++i) add(radians(1.1 * side * i), side * radians(8.0), side);
  }
  return all;
}

TEST(MountFit, GainDelayAndBacklashAreFoundWithTheirErrors) {
  const Mount mounts[] = {{1.0, 0.0, 0.0}, {0.94, radians(0.2), 0.25}, {-1.06, 0.0, -0.1}};
  int within = 0, all = 0;
  for (const Mount& m : mounts) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      SCOPED_TRACE(seed);
      const auto fit = fit_mount(readings_of(m, seed, 2));
      ASSERT_TRUE(fit);
      EXPECT_NEAR(fit->gain.value, m.gain, 0.005);
      EXPECT_NEAR(fit->delay_s.value, m.delay_s, 0.003);
      EXPECT_NEAR(fit->backlash_rad.value, m.backlash_rad, radians(0.03));
      EXPECT_NEAR(fit->position_sd_rad, radians(0.02), radians(0.016));
      within += std::abs(fit->gain.value - m.gain) < 2.0 * fit->gain.sd;
      within += std::abs(fit->delay_s.value - m.delay_s) < 2.0 * fit->delay_s.sd;
      all += 2;
    }
  }
  EXPECT_GT(within, 0.85 * all);
}

// In a pass, reports and pictures agree to a thousandth of a degree, and the speed hardly changes.
// At rest, each place is missed by some other error. The good pictures of the passes must not
// choose a backlash for the places.
TEST(MountFit, ExactPassesDoNotDistortTheBacklash) {
  constexpr double kDelay_s = 0.25;
  int within = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    std::normal_distribution<double> place(0.0, radians(0.05)), rate(0.0, radians(0.005));
    std::vector<MountReading> all;
    for (const int side : {-1, 1, -1}) {
      for (int i = -3; i <= 3; ++i) {
        const double reported_rad = radians(1.7 * side * i);
        all.push_back({reported_rad, 0.0, side, reported_rad + place(random), false});
      }
    }
    const double missed_rad = place(random);
    for (const int side : {1, -1, 1, -1}) {
      for (int i = -4; i <= 4; ++i) {
        const double reported_rad = radians(2.5 * side * i), speed_rad_s = side * radians(5.4);
        // At the end, the report has not turned round yet.
        const double late_rad = (i == 4 ? -0.1 : kDelay_s) * speed_rad_s;
        all.push_back({reported_rad, speed_rad_s + rate(random), side,
                       reported_rad + missed_rad + late_rad, true});
      }
    }
    const auto fit = fit_mount(all);
    ASSERT_TRUE(fit);
    EXPECT_NEAR(fit->gain.value, 1.0, 0.005);
    EXPECT_NEAR(fit->delay_s.value, kDelay_s, 0.01);
    EXPECT_NEAR(fit->backlash_rad.value, 0.0, radians(0.08));
    EXPECT_NEAR(fit->position_sd_rad, radians(0.05), radians(0.03));
    within += std::abs(fit->backlash_rad.value) < 2.0 * fit->backlash_rad.sd;
    within += std::abs(fit->delay_s.value - kDelay_s) < 2.0 * fit->delay_s.sd;
  }
  EXPECT_GT(within, 34);
}

TEST(MountFit, DelaysOfTwoAxesThatContradictEachOtherAreNoticed) {
  const auto delayed = [](double delay_s, std::uint64_t seed) {
    return *fit_mount(readings_of({1.0, 0.0, delay_s}, seed));
  };
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    EXPECT_FALSE(have_different_delays(delayed(0.25, seed), delayed(0.25, seed + 100)));
    EXPECT_TRUE(have_different_delays(delayed(0.25, seed), delayed(0.20, seed + 100)));
  }
  MountFit unsure = delayed(0.25, 1);
  unsure.delay_s.sd = 0.05;
  EXPECT_FALSE(have_different_delays(unsure, delayed(0.15, 2)));
}

TEST(MountFit, WithoutMotionOrFromOneSideLessIsSaid) {
  std::vector<MountReading> all = readings_of({1.0, 0.0, 0.1}, 1);
  auto rests = all;
  std::erase_if(rests, [](const auto& r) { return r.moves; });
  EXPECT_FALSE(fit_mount(rests));
  EXPECT_FALSE(fit_mount({}));
  auto stood = all;  // it was ordered to turn, and did not
  for (MountReading& r : stood) r.rate_rad_s = r.moves ? 1e-4 : 0.0;
  EXPECT_FALSE(fit_mount(stood));
  for (MountReading& r : all) r.approach = 1;
  const auto fit = fit_mount(all);
  ASSERT_TRUE(fit);
  EXPECT_EQ(fit->backlash_rad.sd, 0.0);
  for (MountReading& r : all) r.reported_rad = 0.0;
  EXPECT_FALSE(fit_mount(all));
}

}  // namespace
}  // namespace ols::calibration
