#include "edge/camera/clock_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "edge/camera/frame_clock.h"

namespace ols {
namespace {

// A camera's clock that is off by a constant and a rate, read over a network that takes its time.
struct World {
  double start_s = 5000.0;  // monotonic
  std::int64_t start_ns = 1'700'000'000'000'000'000;
  double rate_error = 50e-6;  // > 0: the camera's clock is slow
  std::mt19937_64 random{1};

  std::int64_t device_ns(double time_s) const {
    return start_ns + std::llround(1e9 * (time_s - start_s) / (1.0 + rate_error));
  }
  // The way there and back take 50 us and an exponential time more, each.
  LatchSample latch(double time_s, double mean_extra_s = 100e-6) {
    std::exponential_distribution<double> extra(1.0 / mean_extra_s);
    const double there_s = 50e-6 + extra(random), back_s = 50e-6 + extra(random);
    return {.device_ns = device_ns(time_s + there_s),
            .before_s = time_s,
            .after_s = time_s + there_s + back_s};
  }
};

double error_s(const ClockMap& map, const World& world, double time_s) {
  return map.from_latches(world.device_ns(time_s))->time_s - time_s;
}

TEST(ClockMap, KnowsNothingBeforeTheFirstSample) {
  const ClockMap map(ClockMap::Config{});
  EXPECT_FALSE(map.from_latches(1));
  EXPECT_FALSE(map.from_arrivals(1, 0.0));
}

TEST(ClockMap, FindsOffsetAndRate) {
  World world;
  ClockMap map(ClockMap::Config{});
  for (int i = 0; i < 60; ++i) ASSERT_TRUE(map.add_latch(world.latch(world.start_s + i)));
  EXPECT_NEAR(map.rate_error(), 50e-6, 3e-6);
  EXPECT_NEAR(error_s(map, world, world.start_s + 60.0), 0.0, 100e-6);
  // The rate alone would make 1 ms of the 20 s ahead.
  EXPECT_NEAR(error_s(map, world, world.start_s + 80.0), 0.0, 200e-6);
}

TEST(ClockMap, UncertaintyIsHonest) {
  // Over many worlds and instants the error in units of its sigma is about 1, or a little less for
  // what the sigma holds in reserve against an uneven way.
  double square = 0.0;
  int count = 0, beyond = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    World world;
    world.random.seed(seed);
    world.rate_error = std::normal_distribution<double>(0.0, 50e-6)(world.random);
    ClockMap map(ClockMap::Config{});
    for (int i = 0; i < 1 + static_cast<int>(seed % 40); ++i) {
      map.add_latch(world.latch(world.start_s + i));
      const double at_s = world.start_s + i + 0.5;
      const auto mapped = *map.from_latches(world.device_ns(at_s));
      const double z = (mapped.time_s - at_s) / mapped.sd_s;
      square += z * z;
      beyond += std::abs(z) > 3.0 ? 1 : 0;
      ++count;
    }
  }
  const double rms = std::sqrt(square / count);
  EXPECT_GT(rms, 0.25);
  EXPECT_LT(rms, 1.2);
  EXPECT_LT(beyond, count / 100);
}

TEST(ClockMap, UncertaintyCoversAnUnevenWay) {
  // All of the delay lies on the way back: the worst that an interval can hide.
  World world;
  ClockMap map(ClockMap::Config{});
  for (int i = 0; i < 60; ++i) {
    const double time_s = world.start_s + i;
    map.add_latch(
        {.device_ns = world.device_ns(time_s), .before_s = time_s, .after_s = time_s + 1e-3});
  }
  const double at_s = world.start_s + 60.0;
  const auto mapped = *map.from_latches(world.device_ns(at_s));
  EXPECT_LT(std::abs(mapped.time_s - at_s), 2.0 * mapped.sd_s);
}

TEST(ClockMap, UncertaintyGrowsAwayFromTheSamples) {
  World world;
  ClockMap map(ClockMap::Config{});
  for (int i = 0; i < 3; ++i) map.add_latch(world.latch(world.start_s + i));
  const auto near = *map.from_latches(world.device_ns(world.start_s + 3.0));
  const auto far = *map.from_latches(world.device_ns(world.start_s + 60.0));
  EXPECT_GT(far.sd_s, 5.0 * near.sd_s);
}

TEST(ClockMap, OneBadLatchChangesNothing) {
  World world;
  ClockMap map(ClockMap::Config{});
  for (int i = 0; i < 20; ++i) map.add_latch(world.latch(world.start_s + i));
  LatchSample bad = world.latch(world.start_s + 20.0);
  bad.device_ns += 30'000'000;
  map.add_latch(bad);
  for (int i = 21; i < 30; ++i) map.add_latch(world.latch(world.start_s + i));
  EXPECT_NEAR(error_s(map, world, world.start_s + 30.0), 0.0, 150e-6);
  EXPECT_EQ(map.latches(), 29);
}

TEST(ClockMap, AStepOfTheCamerasClockBeginsAnew) {
  for (const std::int64_t step_ns : {5'000'000LL, -5'000'000LL, -1'600'000'000'000'000'000LL}) {
    World world;
    ClockMap map(ClockMap::Config{});
    for (int i = 0; i < 20; ++i) map.add_latch(world.latch(world.start_s + i));
    world.start_ns += step_ns;
    for (int i = 20; i < 22; ++i) map.add_latch(world.latch(world.start_s + i));
    EXPECT_NEAR(error_s(map, world, world.start_s + 22.0), 0.0, 300e-6) << step_ns;
    EXPECT_EQ(map.latches(), 2);
  }
}

TEST(ClockMap, WideIntervalsCountLittle) {
  World world;
  ClockMap map(ClockMap::Config{});
  for (int i = 0; i < 10; ++i) map.add_latch(world.latch(world.start_s + i, 50e-6));
  for (int i = 10; i < 40; ++i) map.add_latch(world.latch(world.start_s + i, 20e-3));
  EXPECT_NEAR(error_s(map, world, world.start_s + 40.0), 0.0, 3e-3);
}

TEST(ClockMap, RefusesWhatIsNoInterval) {
  ClockMap map(ClockMap::Config{});
  EXPECT_FALSE(map.add_latch({.device_ns = 1, .before_s = 2.0, .after_s = 1.0}));
  EXPECT_FALSE(map.add_latch({.device_ns = 1, .before_s = 0.0, .after_s = NAN}));
  EXPECT_EQ(map.latches(), 0);
}

TEST(ClockMap, ArrivalsGiveTheLowerEnvelope) {
  World world;
  ClockMap map(ClockMap::Config{});
  std::exponential_distribution<double> extra(1.0 / 5e-3);
  for (int i = 0; i < 300; ++i) {
    const double at_s = world.start_s + i / 15.0;
    map.add_arrival(world.device_ns(at_s), at_s + 0.015 + extra(world.random));
  }
  const double at_s = world.start_s + 20.0;
  const auto mapped = *map.from_arrivals(world.device_ns(at_s), 0.015);
  EXPECT_LT(std::abs(mapped.time_s - at_s), 2.0 * mapped.sd_s);
}

TEST(ClockMap, ArrivalsSurviveAStepBackOfTheCamerasClock) {
  World world;
  ClockMap map(ClockMap::Config{});
  for (int i = 0; i < 30; ++i) {
    if (i == 20) world.start_ns -= 3'600'000'000'000;
    const double at_s = world.start_s + i / 15.0;
    map.add_arrival(world.device_ns(at_s), at_s + 0.015);
  }
  const double at_s = world.start_s + 2.0;
  EXPECT_NEAR(map.from_arrivals(world.device_ns(at_s), 0.015)->time_s, at_s, 1e-3);
}

ExposureLog fixed(double exposure_s) { return ExposureLog(exposure_s, 1.0 / 15.0); }

TEST(FrameClock, TakesTheMiddleOfTheExposureOnEitherSideOfTheStamp) {
  World world;
  for (const StampAt stamp_at : {StampAt::kExposureStart, StampAt::kExposureEnd}) {
    FrameClock clock(FrameClock::Config{.stamp_at = stamp_at, .map = {}});
    for (int i = 0; i < 10; ++i) clock.map().add_latch(world.latch(world.start_s + i));
    const double stamp_s = world.start_s + 10.0;
    const FrameTime time = clock.stamp(world.device_ns(stamp_s), stamp_s + 0.03, fixed(0.020));
    const double expected_s = stamp_s + (stamp_at == StampAt::kExposureStart ? 0.010 : -0.010);
    EXPECT_NEAR(time.mid_exposure_s, expected_s, 300e-6);
    EXPECT_EQ(time.source, StampSource::kCamera);
    EXPECT_LT(time.sd_s, 1e-3);
  }
}

TEST(FrameClock, WithoutALatchTheArrivalsTellAndTheUncertaintySaysSo) {
  World world;
  FrameClock clock(FrameClock::Config{.readout_s = 0.008, .readout_sd_s = 0.004, .map = {}});
  const double stamp_s = world.start_s;
  const FrameTime time =
      clock.stamp(world.device_ns(stamp_s), stamp_s + 0.005 + 0.008, fixed(0.005));
  EXPECT_NEAR(time.mid_exposure_s, stamp_s + 0.0025, 1e-6);
  EXPECT_EQ(time.source, StampSource::kCamera);
  EXPECT_GE(time.sd_s, 0.004);
}

TEST(FrameClock, WithoutAStampTheArrivalIsMarked) {
  FrameClock clock(FrameClock::Config{.readout_s = 0.008, .readout_sd_s = 0.004, .map = {}});
  const FrameTime time = clock.stamp(std::nullopt, 100.0, fixed(0.006));
  EXPECT_DOUBLE_EQ(time.mid_exposure_s, 100.0 - 0.008 - 0.003);
  EXPECT_DOUBLE_EQ(time.sd_s, 0.004);
  EXPECT_EQ(time.source, StampSource::kArrival);
}

TEST(FrameClock, ALatchOfAnotherClockThanTheStampsIsNotBelieved) {
  World world, other;
  other.start_ns = 77;
  FrameClock clock(FrameClock::Config{.map = {}});
  for (int i = 0; i < 10; ++i) clock.map().add_latch(other.latch(world.start_s + i));
  const double stamp_s = world.start_s + 10.0;
  const FrameTime time = clock.stamp(world.device_ns(stamp_s), stamp_s + 0.015, fixed(0.005));
  EXPECT_NEAR(time.mid_exposure_s, stamp_s + 0.0025, 3.0 * time.sd_s);
  EXPECT_GT(time.sd_s, 1e-3);
}

// As after seconds without a processor: the kernel has kept the frames, and they arrive late.
TEST(FrameClock, FramesThatWaitedForTheStationKeepTheirTime) {
  World world;
  FrameClock clock(FrameClock::Config{.map = {}});
  for (int i = 0; i < 10; ++i) clock.map().add_latch(world.latch(world.start_s + i));
  for (int i = 0; i < 60; ++i) {
    const double stamp_s = world.start_s + 10.0 + i / 15.0;
    const double wake_s = world.start_s + 13.0;
    const bool asleep = i >= 15 && i < 45;
    const double arrival_s = asleep ? wake_s + 1e-4 * i : stamp_s + 0.015;
    const FrameTime time = clock.stamp(world.device_ns(stamp_s), arrival_s, fixed(0.005));
    EXPECT_NEAR(time.mid_exposure_s, stamp_s + 0.0025, 1e-3) << i;
    EXPECT_LT(time.sd_s, 1e-3) << i;
  }
}

// A camera whose clock is TAI, and a station that knows where TAI is, but for `error_s`.
struct PtpSlave {
  static constexpr std::int64_t kTaiAt0_ns = 1'700'000'037'000'000'000;
  FrameClock clock{FrameClock::Config{.map = {}}};

  explicit PtpSlave(double error_s, double sd_s) {
    for (int i = 0; i < 10; ++i)
      clock.map().add_latch(
          {.device_ns = device_ns(100.0 + i), .before_s = 99.9995 + i, .after_s = 100.0004 + i});
    clock.set_tai(TaiReference{.monotonic_minus_tai_ns = -kTaiAt0_ns + std::llround(1e9 * error_s),
                               .sd_s = sd_s});
  }
  static std::int64_t device_ns(double time_s) { return kTaiAt0_ns + std::llround(1e9 * time_s); }
  FrameTime stamp() { return clock.stamp(device_ns(110.0), 110.02, fixed(0.010)); }
};

TEST(FrameClock, PtpIsTheBetterClockWhereTheStationsOwnIsSynchronised) {
  PtpSlave slave(0.0, 2e-6);
  const FrameTime time = slave.stamp();
  EXPECT_NEAR(time.mid_exposure_s, 110.005, 1e-6);  // the latches are 50 us off
  EXPECT_DOUBLE_EQ(time.sd_s, 2e-6);
  EXPECT_FALSE(slave.clock.tai_disagreement_s());
}

TEST(FrameClock, TheLatchesCountWhereTheyAreBetterThanPtp) {
  PtpSlave slave(0.002, 5e-3);
  const FrameTime time = slave.stamp();
  EXPECT_NEAR(time.mid_exposure_s, 110.005, 100e-6);
  EXPECT_LT(time.sd_s, 1e-3);
  EXPECT_FALSE(slave.clock.tai_disagreement_s());
}

TEST(FrameClock, APtpThatDisagreesWithTheLatchesIsNotBelieved) {
  // A leap second, the wrong epoch, a stepped station clock, some milliseconds.
  for (const double error_s : {1.0, -37.0, 2.0, -0.01}) {
    PtpSlave slave(error_s, 10e-6);
    const FrameTime time = slave.stamp();
    EXPECT_NEAR(time.mid_exposure_s, 110.005, 100e-6) << error_s;
    ASSERT_TRUE(slave.clock.tai_disagreement_s()) << error_s;
    EXPECT_NEAR(*slave.clock.tai_disagreement_s(), error_s, 1e-3);
  }
}

TEST(FrameClock, AnExposureThatMayBeEitherIsInTheUncertainty) {
  World world;
  FrameClock clock(FrameClock::Config{.map = {}});
  for (int i = 0; i < 10; ++i) clock.map().add_latch(world.latch(world.start_s + i));
  const double stamp_s = world.start_s + 10.0;
  ExposureLog exposures = fixed(0.004);
  exposures.change(stamp_s - 0.01, stamp_s - 0.008, 0.012);
  const FrameTime time = clock.stamp(world.device_ns(stamp_s), stamp_s + 0.03, exposures);
  EXPECT_NEAR(time.mid_exposure_s, stamp_s + 0.004, 300e-6);
  EXPECT_GE(time.sd_s, 0.002);  // it is 2 ms off either way
}

}  // namespace
}  // namespace ols
