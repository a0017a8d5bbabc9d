#include "edge/camera/frame_clock.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/edge/camera/camera_world.h"

namespace ols::camera {
namespace {

ExposureLog fixed(double exposure_s) { return ExposureLog(exposure_s, 1.0 / 15.0); }

TEST(FrameClock, TakesTheMiddleOfTheExposureOnEitherSideOfTheStamp) {
  CameraWorld world;
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
  CameraWorld world;
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
  CameraWorld world, other;
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
  CameraWorld world;
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
  CameraWorld world;
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
}  // namespace ols::camera
