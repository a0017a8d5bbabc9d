#include "edge/clock/clock_watch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace ols::clock {
namespace {

using testing::HasSubstr;

constexpr std::int64_t kEpoch_us = 1'700'000'000'000'000;

// A machine's two clocks, ticked every 10 ms.
class Machine {
 public:
  explicit Machine(const ClockWatch::Config& config = {}) : watch(config) {}
  explicit Machine(double runs_s) : Machine() { run(runs_s); }

  void run(double duration_s, double slew_per_s = 0.0) {
    const double end_s = now_s + duration_s;
    while (now_s < end_s - 1e-9) {
      now_s += 0.01;
      offset_s += 0.01 * slew_per_s;
      watch.tick(now_s, utime_us());
    }
  }
  void step(double by_s) { offset_s += by_s; }
  std::int64_t utime_us() const { return kEpoch_us + std::llround((now_s + offset_s) * 1e6); }

  ClockReading reading(bool synchronised, double error_s = 1e-5) const {
    ClockReading r;
    r.monotonic_s = now_s;
    r.utime_us = utime_us();
    r.service = true;
    r.synchronised = synchronised;
    r.source = "chrony: PPS";
    if (synchronised) {
      r.estimated_error_s = error_s;
      r.measured_utc_s = measured_utc_s;
    }
    return r;
  }
  ClockReading none() const {
    ClockReading r;
    r.monotonic_s = now_s;
    return r;
  }
  void measure() { measured_utc_s = now_s + offset_s; }

  ClockQuality quality() const { return watch.quality(now_s); }

  ClockWatch watch;
  double now_s = 100.0, offset_s = 0.0, measured_utc_s = 0.0;
};

TEST(ClockWatch, WithoutAServiceTheClockIsUnknownNotBad) {
  Machine machine(1.0);
  EXPECT_EQ(machine.quality().state, ClockState::kUnknown);
  machine.watch.add(machine.none());
  const ClockQuality quality = machine.quality();
  EXPECT_EQ(quality.state, ClockState::kUnknown);
  EXPECT_EQ(quality.error_s, 1e-3);
  EXPECT_EQ(quality.alarm, "");
}

TEST(ClockWatch, TheServicesEstimateIsTheError) {
  Machine machine(1.0);
  machine.watch.add(machine.reading(true, 2e-5));
  const ClockQuality quality = machine.quality();
  EXPECT_EQ(quality.state, ClockState::kSynchronised);
  EXPECT_EQ(quality.error_s, 2e-5);
  EXPECT_EQ(quality.text, "synchronised by chrony: PPS, 20 us");
  EXPECT_EQ(quality.alarm, "");
}

TEST(ClockWatch, AServiceWithoutAnEstimateIsTakenAsAssumed) {
  Machine machine;
  ClockReading reading = machine.reading(true);
  reading.estimated_error_s.reset();
  machine.watch.add(reading);
  EXPECT_EQ(machine.quality().error_s, 1e-3);
}

TEST(ClockWatch, AServiceThatWasNeverSynchronised) {
  Machine machine;
  machine.watch.add(machine.reading(false));
  const ClockQuality quality = machine.quality();
  EXPECT_EQ(quality.state, ClockState::kUnsynchronised);
  EXPECT_EQ(quality.error_s, 1.0);
  EXPECT_THAT(quality.alarm, HasSubstr("clock: not synchronised yet"));
}

TEST(ClockWatch, TheErrorGrowsWhenTheServiceLosesItsSource) {
  Machine machine;
  machine.watch.add(machine.reading(true, 1e-5));
  machine.run(100.0);
  machine.watch.add(machine.reading(false));
  const ClockQuality quality = machine.quality();
  EXPECT_EQ(quality.state, ClockState::kUnsynchronised);
  EXPECT_NEAR(quality.error_s, std::hypot(1e-5, 2e-5 * 100.0), 1e-7);
  EXPECT_THAT(quality.alarm, HasSubstr("clock: synchronisation lost 100 s ago"));
  machine.watch.add(machine.reading(true, 1e-5));
  EXPECT_EQ(machine.quality().state, ClockState::kSynchronised);
}

TEST(ClockWatch, AServiceThatIsSilentIsNotBelievedForEver) {
  Machine machine;
  machine.watch.add(machine.reading(true, 1e-5));
  machine.run(29.0);
  EXPECT_EQ(machine.quality().error_s, 1e-5);
  machine.run(31.0);
  EXPECT_EQ(machine.quality().state, ClockState::kUnsynchronised);
  EXPECT_NEAR(machine.quality().error_s, std::hypot(1e-5, 2e-5 * 60.0), 1e-7);
}

class Stepped : public testing::TestWithParam<double> {};

TEST_P(Stepped, IsMarkedAtTheNextTick) {
  Machine machine(1.0);
  machine.step(GetParam());
  machine.run(0.01);
  const ClockQuality quality = machine.quality();
  EXPECT_EQ(quality.state, ClockState::kUnsynchronised);
  EXPECT_EQ(quality.steps, 1U);
  EXPECT_NEAR(quality.last_step_s, GetParam(), 1e-5);
  EXPECT_NEAR(quality.error_s, std::hypot(1e-3, GetParam()), 1e-5);
}

INSTANTIATE_TEST_SUITE_P(Sizes, Stepped, testing::Values(2.0, -2.0, 0.06, -0.06, 86400.0));

TEST(ClockWatch, SaysWhenAndByHowMuch) {
  Machine machine(1.0);
  machine.step(2.0);
  machine.run(12.01);
  EXPECT_EQ(machine.quality().alarm, "clock: stepped by +2.000 s 12 s ago");
}

TEST(ClockWatch, WithoutAServiceAStepIsDistrustedForAWhile) {
  Machine machine(1.0);
  machine.step(2.0);
  machine.run(59.0);
  EXPECT_EQ(machine.quality().state, ClockState::kUnsynchronised);
  machine.run(2.0);
  EXPECT_EQ(machine.quality().state, ClockState::kUnknown);
  EXPECT_EQ(machine.quality().error_s, 1e-3);
  EXPECT_EQ(machine.quality().steps, 1U);
}

TEST(ClockWatch, WithAServiceAStepIsDistrustedUntilItHasMeasured) {
  Machine machine;
  machine.measure();
  machine.watch.add(machine.reading(true));
  machine.run(10.0);
  machine.step(2.0);
  machine.run(100.0);
  // chronyd has not looked since, and still calls itself synchronised.
  machine.watch.add(machine.reading(true));
  EXPECT_EQ(machine.quality().state, ClockState::kUnsynchronised);
  EXPECT_NEAR(machine.quality().error_s, 2.0, 0.1);
  machine.measure();
  machine.watch.add(machine.reading(true));
  EXPECT_EQ(machine.quality().state, ClockState::kSynchronised);
  EXPECT_EQ(machine.quality().error_s, 1e-5);
  EXPECT_EQ(machine.quality().steps, 1U);
}

TEST(ClockWatch, AReadingFromBeforeTheStepConfirmsNothing) {
  Machine machine(1.0);
  const ClockReading before = machine.reading(true);
  machine.step(2.0);
  machine.run(0.01);
  machine.watch.add(before);
  EXPECT_EQ(machine.quality().state, ClockState::kUnsynchronised);
}

TEST(ClockWatch, TheKernelsWordConfirmsAStep) {
  Machine machine;
  ClockReading kernel = machine.reading(true);
  kernel.measured_utc_s.reset();
  machine.watch.add(kernel);
  machine.run(1.0);
  machine.step(2.0);
  machine.run(1.0);
  ClockReading cleared = machine.reading(false);  // settimeofday clears the kernel's flag
  machine.watch.add(cleared);
  EXPECT_EQ(machine.quality().state, ClockState::kUnsynchronised);
  kernel.monotonic_s = machine.now_s;
  machine.watch.add(kernel);
  EXPECT_EQ(machine.quality().state, ClockState::kSynchronised);
}

TEST(ClockWatch, AStepThatIsTakenBackLeavesTheClockAsItWas) {
  Machine machine(1.0);
  machine.step(2.0);
  machine.run(1.0);
  machine.step(-2.0);
  machine.run(1.0);
  const ClockQuality quality = machine.quality();
  EXPECT_EQ(quality.steps, 2U);
  EXPECT_EQ(quality.state, ClockState::kUnsynchronised);
  EXPECT_NEAR(quality.error_s, 1e-3, 1e-4);
}

TEST(ClockWatch, SlewingIsNoStep) {
  Machine machine;
  machine.run(600.0, 5e-4);  // 0.3 s in all, as adjtime does it
  EXPECT_EQ(machine.quality().steps, 0U);
  machine.run(10.0, 0.08);  // as fast as chronyd ever slews
  EXPECT_EQ(machine.quality().steps, 0U);
}

TEST(ClockWatch, APauseInWhichBothClocksRanIsNoStep) {
  Machine machine(1.0);
  machine.now_s += 3600.0;
  machine.run(1.0);
  EXPECT_EQ(machine.quality().steps, 0U);
}

TEST(ClockWatch, ASuspendedMachineHasTheTimeOfItsBatteryClock) {
  Machine machine(1.0);
  machine.step(3600.0);  // CLOCK_MONOTONIC stood
  machine.run(1.0);
  EXPECT_EQ(machine.quality().state, ClockState::kUnsynchronised);
}

class LeapSecond : public testing::TestWithParam<double> {};  // seconds from midnight

TEST_P(LeapSecond, AnnouncedAndAtMidnightOnly) {
  Machine machine;
  constexpr std::int64_t kDay_us = 86'400'000'000;
  const std::int64_t into_day_us = machine.utime_us() % kDay_us;
  machine.offset_s += 1e-6 * static_cast<double>(kDay_us - into_day_us) + GetParam();
  ClockReading reading = machine.reading(true);
  reading.leap_s = 1;
  machine.watch.add(reading);
  machine.run(0.5);
  machine.step(-1.0);  // 23:59:60 is over
  machine.run(0.5);
  const bool at_midnight = std::abs(GetParam()) < 5.0;
  EXPECT_EQ(machine.quality().steps, at_midnight ? 0U : 1U);
}

INSTANTIATE_TEST_SUITE_P(Around, LeapSecond, testing::Values(-0.5, 0.5, 1.0, 3600.0, -3600.0));

TEST(ClockWatch, AJumpOfASecondAtMidnightWithoutAnnouncementIsAStep) {
  Machine machine;
  constexpr std::int64_t kDay_us = 86'400'000'000;
  machine.offset_s += 1e-6 * static_cast<double>(kDay_us - machine.utime_us() % kDay_us);
  machine.watch.add(machine.reading(true));
  machine.run(0.5);
  machine.step(-1.0);
  machine.run(0.5);
  EXPECT_EQ(machine.quality().steps, 1U);
}

TEST(ClockWatch, HandsOnOffsetAndTai) {
  Machine machine;
  ClockReading reading = machine.reading(true);
  reading.offset_s = -3e-6;
  reading.tai_minus_utc_s = 37;
  machine.watch.add(reading);
  EXPECT_EQ(machine.quality().offset_s, -3e-6);
  EXPECT_EQ(machine.quality().tai_minus_utc_s, 37);
}

}  // namespace
}  // namespace ols::clock
