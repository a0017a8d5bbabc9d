#include "edge/camera/clock_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/unit/edge/camera/camera_world.h"

namespace ols::camera {
namespace {

class ClockMapTest : public testing::Test {
 protected:
  double error_s(double time_s) const {
    return map.from_latches(world.device_ns(time_s))->time_s - time_s;
  }
  // A latch a second, from this second to before that one.
  void latch(int from, int to, double mean_extra_s = 100e-6) {
    for (int i = from; i < to; ++i) map.add_latch(world.latch(world.start_s + i, mean_extra_s));
  }

  CameraWorld world;
  ClockMap map{ClockMap::Config{}};
};

TEST(ClockMap, KnowsNothingBeforeTheFirstSample) {
  const ClockMap map(ClockMap::Config{});
  EXPECT_FALSE(map.from_latches(1));
  EXPECT_FALSE(map.from_arrivals(1, 0.0));
}

TEST_F(ClockMapTest, FindsOffsetAndRate) {
  for (int i = 0; i < 60; ++i) ASSERT_TRUE(map.add_latch(world.latch(world.start_s + i)));
  EXPECT_NEAR(map.rate_error(), 50e-6, 3e-6);
  EXPECT_NEAR(error_s(world.start_s + 60.0), 0.0, 100e-6);
  // The rate alone would make 1 ms of the 20 s ahead.
  EXPECT_NEAR(error_s(world.start_s + 80.0), 0.0, 200e-6);
}

TEST(ClockMap, UncertaintyIsHonest) {
  // Over many worlds and instants the error in units of its sigma is about 1, or a little less for
  // what the sigma holds in reserve against an uneven way.
  double square = 0.0;
  int count = 0, beyond = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    CameraWorld world;
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

TEST_F(ClockMapTest, UncertaintyCoversAnUnevenWay) {
  // All of the delay lies on the way back: the worst that an interval can hide.
  for (int i = 0; i < 60; ++i) {
    const double time_s = world.start_s + i;
    map.add_latch(
        {.device_ns = world.device_ns(time_s), .before_s = time_s, .after_s = time_s + 1e-3});
  }
  const double at_s = world.start_s + 60.0;
  const auto mapped = *map.from_latches(world.device_ns(at_s));
  EXPECT_LT(std::abs(mapped.time_s - at_s), 2.0 * mapped.sd_s);
}

TEST_F(ClockMapTest, UncertaintyGrowsAwayFromTheSamples) {
  latch(0, 3);
  const auto near = *map.from_latches(world.device_ns(world.start_s + 3.0));
  const auto far = *map.from_latches(world.device_ns(world.start_s + 60.0));
  EXPECT_GT(far.sd_s, 5.0 * near.sd_s);
}

TEST_F(ClockMapTest, OneBadLatchChangesNothing) {
  latch(0, 20);
  LatchSample bad = world.latch(world.start_s + 20.0);
  bad.device_ns += 30'000'000;
  map.add_latch(bad);
  latch(21, 30);
  EXPECT_NEAR(error_s(world.start_s + 30.0), 0.0, 150e-6);
  EXPECT_EQ(map.latches(), 29);
}

TEST_F(ClockMapTest, AStepOfTheCamerasClockBeginsAnew) {
  for (const std::int64_t step_ns : {5'000'000LL, -5'000'000LL, -1'600'000'000'000'000'000LL}) {
    world = {};
    map = ClockMap(ClockMap::Config{});
    latch(0, 20);
    world.start_ns += step_ns;
    latch(20, 22);
    EXPECT_NEAR(error_s(world.start_s + 22.0), 0.0, 300e-6) << step_ns;
    EXPECT_EQ(map.latches(), 2);
  }
}

TEST_F(ClockMapTest, WideIntervalsCountLittle) {
  latch(0, 10, 50e-6);
  latch(10, 40, 20e-3);
  EXPECT_NEAR(error_s(world.start_s + 40.0), 0.0, 3e-3);
}

TEST(ClockMap, RefusesWhatIsNoInterval) {
  ClockMap map(ClockMap::Config{});
  EXPECT_FALSE(map.add_latch({.device_ns = 1, .before_s = 2.0, .after_s = 1.0}));
  EXPECT_FALSE(map.add_latch({.device_ns = 1, .before_s = 0.0, .after_s = NAN}));
  EXPECT_EQ(map.latches(), 0);
}

TEST_F(ClockMapTest, ArrivalsGiveTheLowerEnvelope) {
  std::exponential_distribution<double> extra(1.0 / 5e-3);
  for (int i = 0; i < 300; ++i) {
    const double at_s = world.start_s + i / 15.0;
    map.add_arrival(world.device_ns(at_s), at_s + 0.015 + extra(world.random));
  }
  const double at_s = world.start_s + 20.0;
  const auto mapped = *map.from_arrivals(world.device_ns(at_s), 0.015);
  EXPECT_LT(std::abs(mapped.time_s - at_s), 2.0 * mapped.sd_s);
}

TEST_F(ClockMapTest, ArrivalsSurviveAStepBackOfTheCamerasClock) {
  for (int i = 0; i < 30; ++i) {
    if (i == 20) world.start_ns -= 3'600'000'000'000;
    const double at_s = world.start_s + i / 15.0;
    map.add_arrival(world.device_ns(at_s), at_s + 0.015);
  }
  const double at_s = world.start_s + 2.0;
  EXPECT_NEAR(map.from_arrivals(world.device_ns(at_s), 0.015)->time_s, at_s, 1e-3);
}

}  // namespace
}  // namespace ols::camera
