#include "edge/camera/rtsp/rtsp_clock.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace ols::camera {
namespace {

constexpr std::int64_t kUtcMinusMonotonic_ns = 1'700'000'000'000'000'000;

// A camera that sends 25 pictures a second, by TCP over a network that holds some up.
struct RtspWorld {
  double delay_s = 0.4;      // least, mid-exposure to arrival
  double jitter_s = 0.004;   // mean of an exponential one
  double stamp_rate = 1.0;   // seconds of stamps a second
  double clock_off_s = 0.0;  // of the camera's UTC
  double clock_drift = 0.0;
  double report_every_s = 5.0;  // 0: never
  double first_report_s = 10.0;
  double start_s = 1000.0;
  std::mt19937_64 random{7};

  std::int64_t device_ns(double time_s) const {
    return std::llround(1e9 * stamp_rate * (time_s - start_s));
  }
  RtspStamp picture(double time_s) {
    std::exponential_distribution<double> jitter(1.0 / jitter_s);
    RtspStamp stamp{.device_ns = device_ns(time_s),
                    .arrival_s = time_s + delay_s + jitter(random),
                    .report_utc_ns = {}};
    const double since_s = time_s - start_s - first_report_s;
    if (report_every_s > 0.0 && since_s >= 0.0) {
      const double report_s =
          start_s + first_report_s + report_every_s * std::floor(since_s / report_every_s);
      const double utc_s = report_s + clock_off_s + clock_drift * (report_s - start_s);
      stamp.report_utc_ns = kUtcMinusMonotonic_ns + std::llround(1e9 * utc_s) +
                            (stamp.device_ns - device_ns(report_s));
    }
    return stamp;
  }
};

struct Judged {
  double worst_s = 0.0, square_s2 = 0.0, told_s2 = 0.0;
  int count = 0, by_reports = 0, jumps = 0;
  int beyond = 0;  // number of times that are off by more than four of their sigmas
  double largest_jump_s = 0.0;
  double rms_s() const { return std::sqrt(square_s2 / count); }
  double told_over_actual() const { return std::sqrt(told_s2 / square_s2); }
};

// From `from_s` after the start on, for `for_s`; each picture before that is seen as well.
Judged run(RtspWorld& world, RtspClock& clock, double from_s, double for_s) {
  Judged judged;
  for (double since_s = 0.0; since_s < from_s + for_s; since_s += 0.04) {
    const double true_s = world.start_s + since_s;
    const FrameTime time = clock.stamp(world.picture(true_s), kUtcMinusMonotonic_ns);
    if (const auto jump_s = clock.jump_s()) {
      ++judged.jumps;
      judged.largest_jump_s = std::max(judged.largest_jump_s, std::abs(*jump_s));
    }
    if (since_s < from_s) continue;
    const double error_s = time.mid_exposure_s - true_s;
    judged.worst_s = std::max(judged.worst_s, std::abs(error_s));
    judged.square_s2 += error_s * error_s;
    judged.told_s2 += time.sd_s * time.sd_s;
    judged.beyond += std::abs(error_s) > 4.0 * time.sd_s ? 1 : 0;
    judged.by_reports += time.source == StampSource::kCamera ? 1 : 0;
    ++judged.count;
  }
  return judged;
}

TEST(RtspClock, ArrivalsGiveTheTimeBeforeTheFirstReport) {
  RtspWorld world;
  RtspClock clock({.delay_s = 0.35, .delay_sd_s = 0.1});
  const Judged judged = run(world, clock, 0.0, 9.0);
  EXPECT_EQ(judged.by_reports, 0);
  EXPECT_NEAR(judged.rms_s(), 0.05, 0.01) << "what the delay is wrong by";
  EXPECT_NEAR(std::sqrt(judged.told_s2 / judged.count), 0.1, 0.01);
}

TEST(RtspClock, ReportsAreExactAndTheChangeToThemIsSaid) {
  RtspWorld world;
  RtspClock clock({.delay_s = 0.3, .delay_sd_s = 0.2});
  const Judged judged = run(world, clock, 10.1, 60.0);
  EXPECT_EQ(judged.by_reports, judged.count);
  EXPECT_LT(judged.worst_s, 1e-3);
  EXPECT_EQ(judged.jumps, 1);
  EXPECT_NEAR(judged.largest_jump_s, 0.1, 0.01);
  EXPECT_NEAR(clock.learnt_delay()->delay_s, 0.4, 0.01);
}

TEST(RtspClock, TheLearntDelayHoldsWhenTheReportsCease) {
  RtspWorld world;
  RtspClock clock({.delay_s = 0.1, .delay_sd_s = 0.2});
  run(world, clock, 0.0, 60.0);
  clock.restart();
  world.start_s += 100.0;
  world.report_every_s = 0.0;
  const Judged judged = run(world, clock, 20.0, 20.0);
  EXPECT_EQ(judged.by_reports, 0);
  EXPECT_LT(judged.worst_s, 0.01);
  EXPECT_LT(judged.largest_jump_s, 0.01);
}

// Told over actual, by arrivals after five minutes with the delay calibrated to this.
double arrivals_told_over_actual(double calibrated_s) {
  double square_s2 = 0.0, told_s2 = 0.0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    RtspWorld world;
    world.random.seed(seed);
    world.stamp_rate = 1.0 + std::normal_distribution<double>(0.0, 50e-6)(world.random);
    world.report_every_s = 0.0;
    const double off_s = std::normal_distribution<double>(0.0, calibrated_s)(world.random);
    RtspClock clock({.delay_s = world.delay_s + off_s, .delay_sd_s = calibrated_s});
    const Judged judged = run(world, clock, 300.0, 20.0);
    EXPECT_LT(judged.worst_s, 0.015) << "seed " << seed;
    square_s2 += judged.square_s2;
    told_s2 += judged.told_s2;
  }
  return std::sqrt(told_s2 / square_s2);
}

TEST(RtspClock, ArrivalsAreHonestAfterFiveMinutes) {
  for (const double calibrated_s : {0.004, 0.0004}) {
    EXPECT_GT(arrivals_told_over_actual(calibrated_s), 0.7) << calibrated_s;
    EXPECT_LT(arrivals_told_over_actual(calibrated_s), 1.5) << calibrated_s;
  }
}

// With the true delay: what is left is the line through the arrivals. A quiet network shows the
// camera's rate in 20 s, a busy one only later.
TEST(RtspClock, TheLineThroughTheArrivalsIsAsGoodAsStated) {
  for (const double jitter_s : {0.004, 0.1}) {
    for (const double from_s : {20.0, 60.0}) {
      double square_s2 = 0.0, told_s2 = 0.0;
      for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        RtspWorld world;
        world.random.seed(seed);
        world.jitter_s = jitter_s;
        world.stamp_rate = 1.0 + std::normal_distribution<double>(0.0, 50e-6)(world.random);
        world.report_every_s = 0.0;
        RtspClock clock({.delay_s = world.delay_s, .delay_sd_s = 1e-6});
        const Judged judged = run(world, clock, from_s, 2.0);
        square_s2 += judged.square_s2 / judged.count / 60.0;
        told_s2 += judged.told_s2 / judged.count / 60.0;
      }
      // The least of 50 pictures is late by a fiftieth of what they are late by.
      EXPECT_LT(std::sqrt(square_s2), 2.0 * jitter_s / 50.0) << jitter_s << " from " << from_s;
      EXPECT_GT(std::sqrt(told_s2 / square_s2), 0.7) << jitter_s << " from " << from_s;
      EXPECT_LT(std::sqrt(told_s2 / square_s2), 1.5) << jitter_s << " from " << from_s;
    }
  }
}

TEST(RtspClock, TheFirstSecondsOfArrivalsAreNoBetterThanStated) {
  for (const double jitter_s : {0.004, 0.1, 0.2}) {
    for (const double from_s : {2.0, 8.0}) {
      Judged all;
      for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        RtspWorld world;
        world.random.seed(seed);
        world.jitter_s = jitter_s;
        world.report_every_s = 0.0;
        RtspClock clock({.delay_s = world.delay_s, .delay_sd_s = 1e-6});
        const Judged judged = run(world, clock, from_s, 2.0);
        all.square_s2 += judged.square_s2;
        all.told_s2 += judged.told_s2;
        all.count += judged.count;
        all.beyond += judged.beyond;
      }
      EXPECT_GT(all.told_over_actual(), 0.7) << jitter_s << " from " << from_s;
      EXPECT_LT(all.beyond, 0.02 * all.count) << jitter_s << " from " << from_s;
    }
  }
}

// A delay that was learnt in a busy time is too long by some of its own sigmas: that is no reason
// to refuse reports later.
TEST(RtspClock, ReportsAreBelievedInAQuietTimeAfterABusyOne) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    SCOPED_TRACE(seed);
    RtspWorld world;
    world.random.seed(seed);
    world.jitter_s = 0.2;
    RtspClock clock(
        {.delay_s = 0.4, .delay_sd_s = 0.2, .report_delay_s = 0.0, .report_sd_s = 0.0005});
    run(world, clock, 0.0, 60.0);
    clock.restart();
    world.start_s += 100.0;
    world.jitter_s = 0.002;
    const Judged judged = run(world, clock, 30.0, 20.0);
    EXPECT_EQ(judged.by_reports, judged.count);
  }
}

// While host and network are busy, even the least delayed pictures are late, and so is the learnt
// delay.
TEST(RtspClock, ADelayThatWasLearntInABusyTimeIsNoSurerThanThatTime) {
  double square_s2 = 0.0, told_s2 = 0.0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    RtspWorld world;
    world.random.seed(seed);
    world.jitter_s = 0.2;
    RtspClock clock(
        {.delay_s = 0.4, .delay_sd_s = 0.2, .report_delay_s = 0.0, .report_sd_s = 0.0005});
    run(world, clock, 0.0, 60.0);
    ASSERT_TRUE(clock.learnt_delay());
    clock.restart();
    world.start_s += 100.0;
    world.report_every_s = 0.0;
    world.jitter_s = 0.002;
    const Judged judged = run(world, clock, 60.0, 20.0);
    EXPECT_EQ(judged.by_reports, 0);
    square_s2 += judged.square_s2;
    told_s2 += judged.told_s2;
  }
  EXPECT_GT(std::sqrt(square_s2 / (40 * 500)), 0.002);
  EXPECT_GT(std::sqrt(told_s2 / square_s2), 0.7);
  EXPECT_LT(std::sqrt(told_s2 / square_s2), 1.5);
}

TEST(RtspClock, ReportsOfAWrongClockAreNotBelieved) {
  struct Case {
    const char* what;
    double off_s, drift, stamp_rate;
  };
  for (const Case& c : {Case{"local time", 7200.0, 0.0, 1.0}, Case{"ahead", 1.0, 0.0, 1.0},
                        Case{"far behind", -30.0, 0.0, 1.0}, Case{"drifts", 0.0, -2e-3, 1.0},
                        Case{"stamps 25, sends 21", 0.0, 0.0, 0.84}}) {
    RtspWorld world;
    world.clock_off_s = c.off_s;
    world.clock_drift = c.drift;
    world.stamp_rate = c.stamp_rate;
    RtspClock clock({.delay_s = 0.4, .delay_sd_s = 0.05, .report_delay_s = 0, .report_sd_s = 0.01});
    const Judged judged = run(world, clock, 120.0, 60.0);
    EXPECT_EQ(judged.by_reports, 0) << c.what;
    EXPECT_TRUE(clock.refused_delay_s()) << c.what;
    EXPECT_LT(judged.worst_s, 0.1) << c.what;
    EXPECT_NEAR(*clock.rate(), 1.0 / c.stamp_rate, 1e-3) << c.what;
  }
}

// Before the rate of the stamps is known, a report through lying stamps cannot be told from a good
// one. Nothing of it may stay.
TEST(RtspClock, ReportsBeforeTheRateIsKnownTeachNoDelay) {
  for (const double stamp_rate : {0.84, 0.99, 1.007, 1.1}) {
    RtspWorld world;
    world.stamp_rate = stamp_rate;
    world.first_report_s = 0.1;
    RtspClock clock({.delay_s = 0.4, .delay_sd_s = 0.05, .report_delay_s = 0, .report_sd_s = 0.01});
    const Judged judged = run(world, clock, 8.5, 10.0);
    EXPECT_FALSE(clock.learnt_delay()) << stamp_rate;
    EXPECT_LT(judged.worst_s, 0.1) << stamp_rate;
  }
}

// Other programs take the processor for seconds: all pictures of such a time are late alike.
TEST(RtspClock, ABusyHostIsNotTakenForStampsThatLie) {
  int by_reports = 0, all = 0, lies = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    RtspWorld world;
    world.random.seed(seed);
    world.delay_s = 0.05;
    world.first_report_s = 2.0;
    RtspClock clock(
        {.delay_s = 0.06, .delay_sd_s = 0.1, .report_delay_s = 0.0, .report_sd_s = 0.02});
    double held_s = 0.0, until_s = 0.0;
    for (double since_s = 0.0; since_s < 30.0; since_s += 0.04) {
      if (since_s >= until_s) {
        held_s = std::exponential_distribution<double>(1.0 / 0.1)(world.random);
        until_s += std::uniform_real_distribution<double>(1.0, 4.0)(world.random);
      }
      RtspStamp picture = world.picture(world.start_s + since_s);
      picture.arrival_s += held_s;
      const FrameTime time = clock.stamp(picture, kUtcMinusMonotonic_ns);
      lies += std::abs(clock.rate().value_or(1.0) - 1.0) > 5e-3 ? 1 : 0;
      if (since_s < 2.0) continue;
      by_reports += time.source == StampSource::kCamera ? 1 : 0;
      ++all;
    }
  }
  EXPECT_GT(by_reports, 0.97 * all);
  EXPECT_LT(lies, 0.02 * all);
}

TEST(RtspClock, ARateThatIsKnownStaysKnown) {
  RtspWorld world;
  world.stamp_rate = 0.84;
  RtspClock clock({.delay_s = 0.4, .delay_sd_s = 0.05});
  for (double since_s = 0.0; since_s < 20.0; since_s += 0.04) {
    clock.stamp(world.picture(world.start_s + since_s), kUtcMinusMonotonic_ns);
    if (since_s > 8.5) ASSERT_TRUE(clock.rate()) << since_s;
  }
}

TEST(RtspClock, FirstReportsThatAreWrongDoNotOutliveTheirCorrection) {
  RtspWorld world;
  world.clock_off_s = -0.35;
  RtspClock clock({.delay_s = 0.4, .delay_sd_s = 0.2});
  run(world, clock, 0.0, 24.0);
  EXPECT_NEAR(clock.learnt_delay()->delay_s, 0.75, 0.01);
  world.clock_off_s = 0.0;
  Judged judged;
  for (double since_s = 24.0; since_s < 50.0; since_s += 0.04) {
    const FrameTime time = clock.stamp(world.picture(1000.0 + since_s), kUtcMinusMonotonic_ns);
    if (since_s > 40.0) {
      judged.by_reports += time.source == StampSource::kCamera ? 1 : 0;
      judged.worst_s = std::max(judged.worst_s, std::abs(time.mid_exposure_s - 1000.0 - since_s));
    }
  }
  EXPECT_GT(judged.by_reports, 200);
  EXPECT_LT(judged.worst_s, 1e-3);
}

TEST(RtspClock, AStepOfTheStationsUtcIsNotTakenForTheCameras) {
  RtspWorld world;
  RtspClock clock({.delay_s = 0.4, .delay_sd_s = 0.2});
  run(world, clock, 0.0, 60.0);
  const FrameTime time = clock.stamp(world.picture(1060.0), kUtcMinusMonotonic_ns + 300'000'000);
  EXPECT_NEAR(time.mid_exposure_s, 1060.0, 0.01);
  EXPECT_EQ(time.source, StampSource::kArrival);
}

// Two refused reports, eleven minutes apart and none in between, are not eleven minutes of refusal.
TEST(RtspClock, RefusedReportsFarApartForgetNothing) {
  RtspWorld world;
  RtspClock clock({.delay_s = 0.4, .delay_sd_s = 0.1});
  run(world, clock, 0.0, 120.0);
  ASSERT_TRUE(clock.learnt_delay());
  for (const double since_s : {120.0, 780.0}) {
    world.report_every_s = 0.0;
    for (double s = since_s - 20.0; s < since_s; s += 0.04) {
      if (s > 120.0) clock.stamp(world.picture(world.start_s + s), kUtcMinusMonotonic_ns);
    }
    world.report_every_s = 5.0;
    world.clock_off_s = 100.0;
    clock.stamp(world.picture(world.start_s + since_s), kUtcMinusMonotonic_ns);
    EXPECT_TRUE(clock.refused_delay_s()) << since_s;
  }
  EXPECT_TRUE(clock.learnt_delay());
}

TEST(RtspClock, AStepOfTheStampsIsForgotten) {
  for (const double step_s : {0.5, -0.5, 100.0, -100.0}) {
    RtspWorld world;
    world.report_every_s = 0.0;
    RtspClock clock({.delay_s = 0.4, .delay_sd_s = 0.01});
    run(world, clock, 0.0, 60.0);
    double worst_s = 0.0;
    for (double since_s = 60.0; since_s < 80.0; since_s += 0.04) {
      RtspStamp picture = world.picture(1000.0 + since_s);
      picture.device_ns += std::llround(1e9 * step_s);
      const FrameTime time = clock.stamp(picture, kUtcMinusMonotonic_ns);
      EXPECT_LT(time.mid_exposure_s, picture.arrival_s) << step_s;
      if (since_s > 70.0)
        worst_s = std::max(worst_s, std::abs(time.mid_exposure_s - 1000.0 - since_s));
    }
    EXPECT_LT(worst_s, 0.03) << step_s;
  }
}

}  // namespace
}  // namespace ols::camera
