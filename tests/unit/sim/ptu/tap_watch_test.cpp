#include "sim/ptu/tap_watch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "edge/ptu/driver.h"
#include "tests/unit/sim/ptu/master.h"

namespace ols::sim {
namespace {

constexpr double kStep_rad = 11.5714 / 3600.0 * kPi / 180.0;
constexpr double kByte_s = 10.0 / 9600.0;

TEST(PtuTapWatch, KnowsWhichReplyIsWhich) {
  PtuTapWatch watch(kStep_rad);
  watch.master_said("PP TP ", 1.0, 0.0);
  watch.unit_said("* 100\r\n* -200\r\n", 1.002, 0.0);
  watch.master_said("pp tp ps500 ", 1.1, 0.0);
  watch.unit_said("!P* 300\r\n* -200\r\n*\r\n", 1.102, 0.0);
  EXPECT_NEAR(watch.at(1.051).pan_rad, 200 * kStep_rad, 2 * kStep_rad);
  EXPECT_NEAR(watch.at(1.051).tilt_rad, -200 * kStep_rad, 1e-9);
  EXPECT_NEAR(watch.at(1.151).pan_rad, 400 * kStep_rad, 4 * kStep_rad);  // going on as it moved
  EXPECT_NEAR(watch.at(9.0).pan_rad, 300 * kStep_rad, 1e-9);             // not for ever
  EXPECT_EQ(watch.counters().readings, 4U);
}

TEST(PtuTapWatch, TakesTheUnitsOwnResolution) {
  PtuTapWatch watch(kStep_rad);
  watch.master_said("PR TR ", 0.5, 0.0);
  watch.unit_said("* 46.2857\r\n* 11.5714\r\n", 0.6, 0.0);
  watch.master_said("PP TP ", 1.0, 0.0);
  watch.unit_said("* 100\r\n* 100\r\n", 1.002, 0.0);
  EXPECT_NEAR(watch.at(1.0).pan_rad, 400 * kStep_rad, 1e-4);
  EXPECT_NEAR(watch.at(1.0).tilt_rad, 100 * kStep_rad, 1e-9);
}

TEST(PtuTapWatch, BelievesNothingOfABurstWithALostReply) {
  PtuTapWatch watch(kStep_rad);
  watch.master_said("PP TP PS500 ", 1.0, 0.0);
  watch.unit_said("* 7000\r\n*\r\n", 1.002, 0.0);
  EXPECT_EQ(watch.counters().readings, 0U);
  EXPECT_EQ(watch.counters().mismatched, 1U);
  EXPECT_DOUBLE_EQ(watch.at(1.0).pan_rad, 0.0);
  watch.master_said("PP TP ", 1.5, 0.0);
  watch.unit_said("* 1\r\n* 2\r\n", 1.502, 0.0);
  EXPECT_EQ(watch.counters().readings, 2U);
}

TEST(PtuTapWatch, StartsAfreshWhenNothingWasAnswered) {
  PtuTapWatch watch(kStep_rad);
  watch.master_said("PP TP ", 1.0, 0.0);
  watch.master_said(" PP TP ", 3.0, 0.0);
  watch.unit_said("* 5\r\n* 6\r\n", 3.002, 0.0);
  EXPECT_EQ(watch.counters().readings, 2U);
  EXPECT_NEAR(watch.at(3.0).tilt_rad, 6 * kStep_rad, 1e-9);
}

struct PassBy {
  double worst_rad = 0.0, rms_rad = 0.0;
};

// The product's driver moves a simulated unit, in simulated time; the watch sees the bytes.
PassBy track(double rate_rad_s, double lag_s) {
  PtuUnitConfig unit_config = ready_unit();
  unit_config.reply_delay_s = 0.003;
  unit_config.reply_jitter_s = 0.003;
  PtuUnit unit(unit_config, 3, 0.0);
  ptu::PtuConfig config;
  config.poll_interval_s = 0.04;
  ptu::PtuDriver driver(config);
  PtuTapWatch watch(kStep_rad);
  driver.restart(0.0);
  PassBy result;
  double sum = 0.0;
  int count = 0;
  for (double t = 0.0; t < 30.0; t += 1e-3) {
    const std::string said = unit.transmit(t);
    if (!said.empty()) watch.unit_said(said, t, kByte_s);
    driver.receive(said, t);
    // There and back, as a target would lead it.
    mount::Goal goal;
    goal.angles.pan_rad = 0.8 * std::sin(rate_rad_s / 0.8 * t);
    goal.rate.pan_rad = rate_rad_s * std::cos(rate_rad_s / 0.8 * t);
    goal.time_s = t;
    goal.valid_until_s = t + 1.0;
    driver.set_goal(goal);
    const std::string asked = driver.step(t);
    if (!asked.empty()) watch.master_said(asked, t, kByte_s);
    unit.receive(asked, t);
    if (t < 10.0) continue;
    const double error = watch.at(t - lag_s).pan_rad - unit.angles_at(t - lag_s).pan_rad;
    result.worst_rad = std::max(result.worst_rad, std::abs(error));
    sum += error * error;
    ++count;
  }
  result.rms_rad = std::sqrt(sum / count);
  return result;
}

TEST(PtuTapWatch, FollowsAMovingUnit) {
  const PassBy behind = track(0.35, 0.15);  // interpolated
  const PassBy now = track(0.35, 0.0);      // what the next frame is drawn with
  RecordProperty("behind_rms_deg", std::to_string(degrees(behind.rms_rad)));
  RecordProperty("now_rms_deg", std::to_string(degrees(now.rms_rad)));
  EXPECT_LT(degrees(behind.rms_rad), 0.03);
  EXPECT_LT(degrees(now.rms_rad), 0.1);
  std::printf(
      "20 deg/s: interpolated %.4f deg RMS, %.4f worst; extrapolated %.4f RMS, %.4f worst\n",
      degrees(behind.rms_rad), degrees(behind.worst_rad), degrees(now.rms_rad),
      degrees(now.worst_rad));
}

}  // namespace
}  // namespace ols::sim
