#include "tools/doctor/judge_bridge.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ols::doctor {
namespace {

using testing::HasSubstr;

constexpr std::int64_t kUtime_us = 1'700'000'000'000'000;

std::string status(const std::string& alarms, std::int64_t utime_us = kUtime_us) {
  return R"({"utime_us": )" + std::to_string(utime_us) + R"(, "alarms": )" + alarms +
         R"(, "out": {"passed": 12}, "in": {"passed": 3}})";
}

std::string text(const std::string& status) {
  std::string lines;
  for (const Finding& finding : judge_bridge(status, kUtime_us + 1'000'000)) {
    lines += line(finding) + "\n";
  }
  return lines;
}

TEST(DoctorOnBridge, AWellOneSaysWhatPassed) {
  EXPECT_EQ(text(status("[]")), "ok    bridge: connected, 12 messages out, 3 in\n");
}

TEST(DoctorOnBridge, EachAlarmIsAFailure) {
  const std::string lines = text(status(
      R"([{"text": "bridge: no server: x", "id": "bridge_no_server", "parameters": {"why": "x"}},
                                     {"text": "bridge: y", "id": "", "parameters": {}}])"));
  EXPECT_THAT(lines, HasSubstr("FAIL  bridge: no server: x"));
  EXPECT_THAT(lines, HasSubstr("FAIL  bridge: y"));
}

TEST(DoctorOnBridge, AnOldOrMissingOrForeignStatusIsTold) {
  EXPECT_THAT(text(status("[]", kUtime_us - 60'000'000)), HasSubstr("does not run"));
  EXPECT_THAT(text(""), HasSubstr("no status"));
  EXPECT_THAT(text("[1]"), HasSubstr("cannot be read"));
  EXPECT_THAT(text("rubbish"), HasSubstr("cannot be read"));
}

}  // namespace
}  // namespace ols::doctor
