// The retries, counts and reports of a device's thread, with a session in place of a device.
#include "edge/device/device_thread.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>

#include "conditions/alarms.h"
#include "tests/unit/eventually.h"

namespace ols::device {
namespace {

DeviceThread::Config quick() {
  return {"gnss", "is being connected", 0.001, 0.004, alarm::gnss_fails};
}

// Serves until the stop is requested or it is no longer there.
struct Device {
  std::atomic<bool> is_there = false;
  std::atomic<int> sessions = 0;
  std::atomic<bool> ended = false;

  void serve(DeviceThread& thread, const std::stop_token& stop) {
    ++sessions;
    if (!is_there) throw std::runtime_error("not there");
    thread.opened();
    thread.works();
    while (is_there && !stop.stop_requested()) std::this_thread::yield();
    ended = stop.stop_requested();
    if (!ended) throw std::runtime_error("has gone");
  }
};

TEST(DeviceThread, WithoutASessionTheDeviceIsNotConfigured) {
  const DeviceThread thread(quick());
  EXPECT_EQ(thread.report().text, "not configured");
  EXPECT_EQ(thread.report().state, DeviceState::kAbsent);
  EXPECT_TRUE(thread.report().alarms.empty());
}

TEST(DeviceThread, OpensAgainAfterFailuresAndCountsThem) {
  Device device;
  DeviceThread thread(quick());
  thread.start([&](const std::stop_token& stop) { device.serve(thread, stop); });
  ASSERT_TRUE(eventually([&] { return device.sessions >= 3; }));
  DeviceReport report = thread.report();
  EXPECT_EQ(report.state, DeviceState::kAbsent);
  EXPECT_EQ(report.alarms, std::vector{alarm::gnss_fails("not there")});
  EXPECT_GE(report.errors, 2U);
  device.is_there = true;
  ASSERT_TRUE(eventually([&] { return thread.link().is_open; }));
  report = thread.report();
  EXPECT_EQ(report.state, DeviceState::kOk);
  EXPECT_EQ(report.last_error, "not there");
  EXPECT_TRUE(report.alarms.empty());
  device.is_there = false;
  ASSERT_TRUE(eventually([&] { return !thread.link().is_open; }));
  device.is_there = true;
  EXPECT_TRUE(eventually([&] { return thread.link().openings == 2; }));
}

TEST(DeviceThread, AFaultIsCountedOnceWhileItLasts) {
  Device device;
  device.is_there = true;
  DeviceThread thread(quick());
  thread.start([&](const std::stop_token& stop) { device.serve(thread, stop); });
  ASSERT_TRUE(eventually([&] { return thread.link().is_open; }));
  thread.set_fault("silent for 2 s");
  thread.set_fault("silent for 3 s");
  EXPECT_EQ(thread.report().state, DeviceState::kFault);
  EXPECT_EQ(thread.report().text, "silent for 3 s");
  EXPECT_EQ(thread.report().errors, 1U);
  thread.set_fault("");
  EXPECT_EQ(thread.report().state, DeviceState::kOk);
  thread.set_fault("silent for 2 s");
  EXPECT_EQ(thread.report().errors, 2U);
}

TEST(DeviceThread, TheEndStopsTheSessionAndDoesNotWaitForThePause) {
  Device device;
  device.is_there = true;
  {
    DeviceThread thread(quick());
    thread.start([&](const std::stop_token& stop) { device.serve(thread, stop); });
    ASSERT_TRUE(eventually([&] { return thread.link().is_open; }));
  }
  EXPECT_TRUE(device.ended);
  // An hour's pause would run into the test's time limit.
  DeviceThread thread({"gnss", "is being connected", 3600.0, 3600.0});
  thread.start([](const std::stop_token&) { throw std::runtime_error("not there"); });
  EXPECT_TRUE(eventually([&] { return thread.link().failures == 1; }));
}

}  // namespace
}  // namespace ols::device
