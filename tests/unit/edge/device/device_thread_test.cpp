#include "edge/device/device_thread.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <atomic>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>

#include "conditions/alarms.h"
#include "edge/device/behind_control_loop.h"
#include "edge/device/device_report.h"
#include "edge/device/reading_queue.h"
#include "tests/unit/eventually.h"

namespace ols::device {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

int priority_of_this_thread() { return ::getpriority(PRIO_PROCESS, static_cast<id_t>(::gettid())); }

TEST(BehindControlLoop, LowersThisThreadAlone) {
  const int before = priority_of_this_thread();
  if (before >= 10) GTEST_SKIP() << "runs behind everything already";
  int lowered = before;
  std::string failed = "not called";
  std::jthread([&] {
    failed = go_behind_control_loop();
    lowered = priority_of_this_thread();
  }).join();
  EXPECT_EQ(failed, "");
  EXPECT_EQ(lowered, 10);
  EXPECT_EQ(priority_of_this_thread(), before);
}

TEST(DeviceReport, IsOfAnAbsentDeviceUntilItIsFilled) {
  const DeviceReport report;
  EXPECT_EQ(report.state, DeviceState::kAbsent);
  EXPECT_FALSE(report.last_good_s);
  EXPECT_EQ(report.errors, 0U);
}

// ols-doctor and the journal tell states apart by their names.
TEST(DeviceReport, EachStateHasANameOfItsOwn) {
  std::set<std::string> names;
  for (const DeviceState state :
       {DeviceState::kAbsent, DeviceState::kStarting, DeviceState::kOk, DeviceState::kFault}) {
    names.insert(to_string(state));
  }
  EXPECT_EQ(names, (std::set<std::string>{"absent", "starting", "ok", "fault"}));
}

TEST(ReadingQueue, GivesEachReadingOnceAndTheOldestFirst) {
  ReadingQueue<int> queue;
  EXPECT_THAT(queue.take(), IsEmpty());
  queue.add(1);
  queue.add(2);
  EXPECT_THAT(queue.take(), ElementsAre(1, 2));
  EXPECT_THAT(queue.take(), IsEmpty());
  queue.add(3);
  EXPECT_THAT(queue.take(), ElementsAre(3));
}

TEST(ReadingQueue, KeepsTheNewestWhenNobodyTakesThem) {
  constexpr int kMost = ReadingQueue<int>::kMost;
  ReadingQueue<int> queue;
  for (int i = 0; i < kMost; ++i) queue.add(i);
  queue.add(kMost);
  queue.add(kMost + 1);
  const auto readings = queue.take();
  ASSERT_EQ(readings.size(), ReadingQueue<int>::kMost);
  EXPECT_EQ(readings.front(), 2);
  EXPECT_EQ(readings.back(), kMost + 1);
  queue.add(7);
  EXPECT_THAT(queue.take(), ElementsAre(7));
}

// The retries, counts and reports of a device's thread, with a session in place of a device.

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
