#include "sim/camera/exposure_cue.h"

#include <gtest/gtest.h>

#include <thread>

namespace ols::sim {
namespace {

using namespace std::chrono_literals;

TEST(ExposureCue, ATriggerIsTakenOnceWithItsInstant) {
  ExposureCue cue;
  const auto before = ExposureCue::Clock::now();
  cue.trigger(Trigger{});
  const auto taken = cue.wait_for_trigger(0s);
  ASSERT_TRUE(taken);
  EXPECT_GE(taken->second, before);
  EXPECT_FALSE(cue.wait_for_trigger(0s));
}

TEST(ExposureCue, ATriggerWakesTheExposingThread) {
  ExposureCue cue;
  std::thread client([&cue] { cue.trigger(Trigger{}); });
  EXPECT_TRUE(cue.wait_for_trigger(60s));
  client.join();
}

TEST(ExposureCue, WithoutAClientTriggersAreForgotten) {
  ExposureCue cue;
  cue.trigger(Trigger{});
  EXPECT_FALSE(cue.wait_for_client(0s));
  EXPECT_FALSE(cue.wait_for_trigger(0s));
}

TEST(ExposureCue, TheEndEndsEveryWait) {
  ExposureCue cue;
  std::thread owner([&cue] { cue.end(); });
  EXPECT_TRUE(cue.wait_until(ExposureCue::Clock::now() + 1h));
  owner.join();
  EXPECT_TRUE(cue.wait_for_client(1h));
  EXPECT_FALSE(cue.wait_for_trigger(1h));
}

TEST(ExposureCue, AnInstantThatPassesIsNotTheEnd) {
  ExposureCue cue;
  EXPECT_FALSE(cue.wait_until(ExposureCue::Clock::now()));
}

}  // namespace
}  // namespace ols::sim
