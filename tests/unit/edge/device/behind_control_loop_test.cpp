#include "edge/device/behind_control_loop.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <thread>

namespace ols::device {
namespace {

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

}  // namespace
}  // namespace ols::device
