#include "edge/clock/clock_reading.h"

#include <gtest/gtest.h>

namespace ols::clock {
namespace {

ChronyTracking chrony_at_work() {
  ChronyTracking chrony;
  chrony.reference = "PPS";
  chrony.synchronised = true;
  chrony.measured_utc_s = 1000.0;
  chrony.root_dispersion_s = 1e-5;
  return chrony;
}

KernelClock kernel_at_work() {
  KernelClock kernel;
  kernel.synchronised = kernel.loop = true;
  kernel.frequency = 1e-5;
  kernel.estimated_error_s = 2e-4;
  kernel.max_error_s = 0.01;
  return kernel;
}

TEST(ClockReading, AFreshKernelHasNoService) {
  const ClockReading reading = make_clock_reading({}, std::nullopt, false);
  EXPECT_FALSE(reading.service);
  EXPECT_FALSE(reading.synchronised);
  EXPECT_EQ(reading.source, "");
  EXPECT_FALSE(reading.tai_minus_utc_s);
}

TEST(ClockReading, TheKernelsWordWithoutChrony) {
  const ClockReading reading = make_clock_reading(kernel_at_work(), std::nullopt, false);
  EXPECT_TRUE(reading.service);
  EXPECT_TRUE(reading.synchronised);
  EXPECT_EQ(reading.source, "kernel");
  EXPECT_EQ(reading.estimated_error_s, 2e-4);
}

TEST(ClockReading, AnEstimateOfZeroIsNone) {
  KernelClock kernel = kernel_at_work();
  kernel.estimated_error_s = 0.0;  // systemd-timesyncd
  EXPECT_FALSE(make_clock_reading(kernel, std::nullopt, false).estimated_error_s);
}

TEST(ClockReading, EachTraceOfAServiceTellsThatItWasThere) {
  KernelClock frequency, loop, error, greatest;
  frequency.frequency = -3e-6;
  loop.loop = true;
  error.estimated_error_s = 0.1;
  greatest.max_error_s = 1.0;
  for (const KernelClock& kernel : {frequency, loop, error, greatest}) {
    const ClockReading reading = make_clock_reading(kernel, std::nullopt, false);
    EXPECT_TRUE(reading.service);
    EXPECT_FALSE(reading.synchronised);
  }
  EXPECT_TRUE(make_clock_reading({}, std::nullopt, true).service);
}

TEST(ClockReading, ChronysWordGoesFirst) {
  const ClockReading reading = make_clock_reading({}, chrony_at_work(), false);
  EXPECT_TRUE(reading.service);
  EXPECT_TRUE(reading.synchronised);
  EXPECT_EQ(reading.source, "chrony: PPS");
  EXPECT_EQ(reading.measured_utc_s, 1000.0);
  ChronyTracking lost = chrony_at_work();
  lost.synchronised = false;
  lost.reference = "";
  const ClockReading unsynchronised = make_clock_reading(kernel_at_work(), lost, false);
  EXPECT_TRUE(unsynchronised.service);
  EXPECT_FALSE(unsynchronised.synchronised);
  EXPECT_EQ(unsynchronised.source, "chrony: no source");
}

TEST(ClockReading, LeapSecondAndTai) {
  KernelClock kernel = kernel_at_work();
  kernel.leap_s = 1;
  kernel.tai_minus_utc_s = 37;
  const ClockReading reading = make_clock_reading(kernel, std::nullopt, false);
  EXPECT_EQ(reading.leap_s, 1);
  EXPECT_EQ(reading.tai_minus_utc_s, 37);
  ChronyTracking chrony = chrony_at_work();
  chrony.leap_s = -1;
  EXPECT_EQ(make_clock_reading({}, chrony, false).leap_s, -1);
}

}  // namespace
}  // namespace ols::clock
