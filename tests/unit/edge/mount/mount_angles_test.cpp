#include "edge/mount/mount_angles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <deque>
#include <functional>
#include <random>
#include <utility>

#include "geometry/angles.h"

namespace ols::mount {
namespace {

constexpr double kPicture_s = 0.04, kPoll_s = 0.1;

// A mount that reports its pan late, and a camera on it.
struct MountAndCamera {
  double late_s = 0.3, jitter_s = 0.008, delay_sd_s = 0.005;
  double place_sd_rad = radians(0.01);  // as stated
  double step_rad = 0.0, backlash_rad = 0.0;
  double picture_sd_rad = 2e-5, stamp_sd_s = 0.0;
  double scale = 1.0;                        // of what the pictures show
  std::function<double(double)> scene = {};  // [rad/s] the scene's own motion
  bool swings = true;                        // back and forth, up to 5 deg/s; or straight on
  double begins_s = 3.0;                     // it rests until then
};

AngleHistory::Config history_config() {
  AngleHistory::Config config;
  config.max_gap_s = 1.0;
  config.max_extrapolation_s = 0.5;
  config.step_rad = radians(1e-4);
  return config;
}

class Simulated {
 public:
  Simulated(const MountAndCamera& devices, std::uint64_t seed)
      : devices_(devices),
        random_(seed),
        angles_(history_config()),
        delay_error_s_(normal(devices.delay_sd_s)),
        stamp_error_s_(normal(devices.stamp_sd_s)) {}

  double truth(double time_s) const {
    const double turns_s = std::max(0.0, time_s - devices_.begins_s);
    constexpr double kTurns_rad_s = 2.0 * kPi / 12.0;
    if (!devices_.swings) return radians(5.0) * turns_s;
    return radians(5.0) / kTurns_rad_s * std::sin(kTurns_rad_s * turns_s);
  }

  // Until the picture of this instant has arrived, a tenth of a second later.
  void run_to(double end_s) {
    for (; picture_s_ < end_s + 0.5 * kPicture_s; picture_s_ += kPicture_s) {
      while (poll_s_ < picture_s_ + 0.1) {
        report(poll_s_);
        poll_s_ += kPoll_s;
      }
      if (picture_s_ > 0.0) see(picture_s_);
    }
  }
  // Errors of each picture's angle, from one instant to another.
  void judge(double from_s, double to_s) {
    for (double time_s = from_s; time_s < to_s; time_s += kPicture_s) {
      run_to(time_s);
      const double stamp_s = picture_s_ - kPicture_s + stamp_error_s_;
      const double truth_rad = truth(picture_s_ - kPicture_s);
      const auto at = angles_.at(stamp_s, devices_.stamp_sd_s);
      const auto reported = angles_.reported().at(stamp_s);
      if (!at || !reported) continue;
      error2 += std::pow(at->angles.pan_rad - truth_rad, 2);
      told2 += at->covariance(0, 0) + at->lasting_covariance(0, 0);
      lasting2 += at->lasting_covariance(0, 0);
      reported2 += std::pow(reported->angles.pan_rad - truth_rad, 2);
      ++judged;
    }
  }
  MountAngles& angles() { return angles_; }
  double picture_s() const { return picture_s_; }

  double error2 = 0.0, told2 = 0.0, lasting2 = 0.0, reported2 = 0.0;
  int judged = 0;

 private:
  double normal(double sd) { return std::normal_distribution<double>()(random_) * sd; }
  void report(double polled_s) {
    const double holds_s = polled_s - devices_.late_s;
    const double rate = truth(holds_s) - truth(holds_s - 0.01);
    if (rate != 0.0) side_ = rate > 0.0 ? 0.5 : -0.5;
    double pan_rad = truth(holds_s) + side_ * devices_.backlash_rad;
    if (devices_.step_rad > 0.0)
      pan_rad = std::round(pan_rad / devices_.step_rad) * devices_.step_rad;
    angles_.add({.time_s = holds_s + normal(devices_.jitter_s) - delay_error_s_,
                 .time_sd_s = devices_.jitter_s,
                 .angles = {pan_rad, 0.0},
                 .place_sd = {devices_.place_sd_rad, devices_.place_sd_rad},
                 .ordered_change = PanTilt{},
                 .shared_time_sd_s = devices_.delay_sd_s});
  }
  void see(double exposed_s) {
    const double before_s = exposed_s - kPicture_s;
    SeenTurn seen;
    seen.from_s = before_s + stamp_error_s_;
    seen.to_s = exposed_s + stamp_error_s_;
    seen.stamp_sd_s = devices_.stamp_sd_s;
    seen.turn.pan_rad = devices_.scale * (truth(exposed_s) - truth(before_s)) +
                        normal(devices_.picture_sd_rad) +
                        (devices_.scene ? devices_.scene(exposed_s) * kPicture_s : 0.0);
    seen.sd = {devices_.picture_sd_rad, devices_.picture_sd_rad};
    angles_.add(seen);
  }

  MountAndCamera devices_;
  std::mt19937_64 random_;
  MountAngles angles_;
  double delay_error_s_, stamp_error_s_;
  double picture_s_ = 0.0, poll_s_ = 0.0, side_ = 0.0;
};

struct Judged {
  double told_over_actual, over_reported, error_deg, lasting_deg;
};

Judged judge(const MountAndCamera& devices, double from_s = 8.0, double to_s = 28.0,
             int seeds = 20) {
  double error2 = 0.0, told2 = 0.0, lasting2 = 0.0, reported2 = 0.0;
  int judged = 0;
  for (int seed = 1; seed <= seeds; ++seed) {
    Simulated run(devices, static_cast<std::uint64_t>(seed));
    run.judge(from_s, to_s);
    error2 += run.error2;
    told2 += run.told2;
    lasting2 += run.lasting2;
    reported2 += run.reported2;
    judged += run.judged;
  }
  EXPECT_GT(judged, 0.95 * seeds * (to_s - from_s) / kPicture_s);
  return {std::sqrt(told2 / error2), std::sqrt(error2 / reported2),
          degrees(std::sqrt(error2 / judged)), degrees(std::sqrt(lasting2 / judged))};
}

TEST(MountAngles, ThePicturesCarryALateReport) {
  MountAndCamera devices;
  devices.jitter_s = devices.delay_sd_s = devices.picture_sd_rad = 0.0;
  devices.place_sd_rad = radians(1e-4);
  const Judged exact = judge(devices, 8.0, 28.0, 1);
  EXPECT_LT(exact.error_deg, 0.005);
  EXPECT_LT(exact.over_reported, 0.05);
}

TEST(MountAngles, TheErrorIsSmallerAndAsStated) {
  for (const bool swings : {true, false}) {
    const Judged carried = judge({.swings = swings});
    EXPECT_LT(carried.over_reported, 0.5) << swings;
    EXPECT_GT(carried.told_over_actual, 0.7) << swings;
    EXPECT_LT(carried.told_over_actual, 1.5) << swings;
  }
}

// A changing rate shows them.
TEST(MountAngles, LearnsTheDelayAndTheScale) {
  const Judged delay = judge({.delay_sd_s = 0.05});
  EXPECT_LT(delay.over_reported, 0.35);
  EXPECT_GT(delay.told_over_actual, 0.7);
  const Judged scale = judge({.scale = 1.03});
  EXPECT_LT(scale.over_reported, 0.35);
  EXPECT_GT(scale.told_over_actual, 0.7);
}

TEST(MountAngles, TheErrorOfThePicturesStampsIsPartOfTheDelay) {
  const Judged stamped = judge({.stamp_sd_s = 0.015});
  EXPECT_LT(stamped.over_reported, 0.35);
  EXPECT_GT(stamped.told_over_actual, 0.7);
  EXPECT_LT(stamped.told_over_actual, 1.5);
}

// All that is seen moves like clouds.
TEST(MountAngles, LearnsTheScenesOwnMotion) {
  const Judged clouds = judge({.scene = [](double) { return radians(0.4); }});
  EXPECT_LT(clouds.over_reported, 0.4);
  EXPECT_GT(clouds.told_over_actual, 0.7);
  EXPECT_LT(clouds.told_over_actual, 1.5);
}

TEST(MountAngles, APassingObjectDoesNotDeceive) {
  for (const double rate_deg_s : {1.0, 5.0}) {
    const Judged passes =
        judge({.scene =
                   [=](double time_s) {
                     return time_s > 12.0 && time_s < 17.0 ? radians(rate_deg_s) : 0.0;
                   },
               .swings = false});
    EXPECT_LT(passes.over_reported, 1.0) << rate_deg_s;
    EXPECT_GT(passes.told_over_actual, 0.5) << rate_deg_s;
  }
}

// Steps differ from place to place; backlash is the same everywhere.
TEST(MountAngles, OnlyErrorsThatAreSeenToScatterAverageOut) {
  const double step_rad = radians(0.5);
  const Judged steps = judge({.place_sd_rad = step_rad / std::sqrt(12.0), .step_rad = step_rad});
  EXPECT_LT(steps.over_reported, 0.6);
  EXPECT_GT(steps.told_over_actual, 0.7);
  EXPECT_LT(steps.told_over_actual, 2.5);
  EXPECT_LT(steps.lasting_deg, 0.5 * 0.5 / std::sqrt(12.0));
  const Judged backlash = judge({.place_sd_rad = radians(0.1), .backlash_rad = radians(0.2)});
  EXPECT_GT(backlash.told_over_actual, 0.8);
  EXPECT_NEAR(backlash.lasting_deg, 0.1, 0.02);
}

TEST(MountAngles, AtRestTheSameReportAgainDoesNotImproveTheAngle) {
  MountAndCamera devices{.place_sd_rad = radians(0.1)};
  Simulated run(devices, 1);
  run.run_to(2.9);
  const auto at = run.angles().at(run.picture_s() - kPicture_s);
  ASSERT_TRUE(at);
  EXPECT_GT(std::sqrt(at->covariance(0, 0) + at->lasting_covariance(0, 0)), radians(0.1));
}

// Clouds make a mount that rests move neither fast nor slowly.
TEST(MountAngles, TheRateIsWithoutTheScenesOwnMotion) {
  MountAndCamera devices{.picture_sd_rad = 1e-6, .scene = [](double) { return radians(0.4); }};
  devices.begins_s = 1e3;
  Simulated run(devices, 1);
  int carried = 0;
  for (double time_s = 20.0; time_s < 40.0; time_s += kPicture_s) {
    run.run_to(time_s);
    const double picture_s = run.picture_s() - kPicture_s;
    const auto at = run.angles().at(picture_s), reported = run.angles().reported().at(picture_s);
    ASSERT_TRUE(at && reported);
    if (at->angles.pan_rad != reported->angles.pan_rad) ++carried;
    EXPECT_NEAR(degrees(at->rate.pan_rad), 0.0, 0.02) << time_s;
  }
  EXPECT_GT(carried, 100);
}

TEST(MountAngles, TheRateIsThatOfTheMountsScale) {
  MountAndCamera devices{.jitter_s = 0.0, .delay_sd_s = 0.0, .picture_sd_rad = 1e-6};
  devices.place_sd_rad = radians(1e-3);
  devices.scale = 1.03;
  Simulated run(devices, 1);
  run.run_to(27.0);
  EXPECT_NEAR(degrees(run.angles().at(27.0)->rate.pan_rad), 5.0, 0.03);
}

// As those of a unit of FLIR at rest, before and after its newest report; also under clouds.
TEST(MountAngles, ExactReportsNeedNoPictures) {
  constexpr double kStep_rad = 5.61e-5;
  MountAndCamera devices{.jitter_s = 1e-4, .delay_sd_s = 1e-4, .picture_sd_rad = 1e-6};
  devices.step_rad = kStep_rad;
  devices.place_sd_rad = kStep_rad / std::sqrt(12.0);
  devices.begins_s = 1e3;
  for (const double late_s : {-0.2, 0.1}) {
    for (const double scene_deg_s : {0.0, 0.05, 0.4}) {
      devices.late_s = late_s;
      devices.scene = [=](double) { return radians(scene_deg_s); };
      Simulated run(devices, 1);
      for (double time_s = 1.0; time_s < 20.0; time_s += kPicture_s) {
        run.run_to(time_s);
        const double picture_s = run.picture_s() - kPicture_s;
        const auto at = run.angles().at(picture_s),
                   reported = run.angles().reported().at(picture_s);
        ASSERT_TRUE(at && reported);
        EXPECT_EQ(at->angles.pan_rad, reported->angles.pan_rad) << time_s;
        EXPECT_EQ(at->rate.pan_rad, reported->rate.pan_rad) << time_s;
        EXPECT_LT(std::sqrt(at->covariance(0, 0)), radians(0.005)) << time_s;
      }
    }
  }
}

TEST(MountAngles, WithoutPicturesTheReportsAreAll) {
  MountAngles angles(history_config());
  EXPECT_FALSE(angles.at(1.0));
  AngleSample sample;
  for (int i = 0; i < 10; ++i) {
    sample.time_s = 0.1 * i;
    sample.angles.pan_rad = 0.01 * i;
    angles.add(sample);
  }
  EXPECT_NEAR(angles.at(0.85)->angles.pan_rad, 0.085, 1e-12);
  const double stamp_sd_s = 0.1;
  EXPECT_NEAR(angles.at(0.85, stamp_sd_s)->covariance(0, 0) - angles.at(0.85)->covariance(0, 0),
              std::pow(0.1 * stamp_sd_s, 2), 1e-12);
  EXPECT_FALSE(angles.at(2.0)) << "too long after the newest";
}

// After a sky without structure, nothing connects the new pictures with the reports before it.
TEST(MountAngles, ABrokenPathCarriesNothing) {
  MountAngles angles(history_config());
  AngleSample sample;
  SeenTurn seen;
  for (int i = 1; i <= 40; ++i) {
    sample.time_s = 0.1 * i;
    if (i <= 20) angles.add(sample);
    seen.from_s = std::exchange(seen.to_s, 0.1 * i);
    if (i < 25 || i > 30) angles.add(seen);
    EXPECT_EQ(angles.at(0.1 * i).has_value(), i < 26) << i;
  }
}

// The mount is silent: the pictures carry on, with a growing error, but not for ever.
TEST(MountAngles, CarriesOnWithoutReportsForSomeSeconds) {
  MountAngles angles(history_config());
  AngleSample sample;
  sample.doubt = {radians(0.01), radians(0.01)};
  SeenTurn seen;
  seen.sd = {1e-4, 1e-4};
  double before_rad2 = 0.0;
  for (int i = 0; i < 200; ++i) {
    sample.time_s = 0.1 * i;
    if (i <= 20) angles.add(sample);
    seen.from_s = std::exchange(seen.to_s, 0.1 * i);
    if (i > 0) angles.add(seen);
    const auto at = angles.at(0.1 * i);
    if (i >= 2 && i < 69) ASSERT_TRUE(at) << i;
    if (i > 71) ASSERT_FALSE(at) << i;
    if (i > 25 && i < 69) {
      EXPECT_GT(at->covariance(0, 0), before_rad2);
      EXPECT_FALSE(at->interpolated);
    }
    if (at) before_rad2 = at->covariance(0, 0);
  }
  angles.clear();
  EXPECT_FALSE(angles.at(19.9));
}

}  // namespace
}  // namespace ols::mount
