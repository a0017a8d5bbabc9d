#include "tools/doctor/judge_host.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cerrno>

#include "conditions/alarms.h"

namespace ols::doctor {
namespace {

using testing::HasSubstr;

TEST(DoctorOnHost, AClockIsNeverAReasonToStop) {
  clock::ClockQuality clock;
  clock.text = "chrony: PPS";
  clock.state = clock::ClockState::kSynchronised;
  EXPECT_EQ(judge(clock).verdict, Verdict::kOk);
  clock.alarm = alarm::clock_stepped(2.0, 12.0);
  EXPECT_EQ(judge(clock).verdict, Verdict::kWarn);
  clock.state = clock::ClockState::kUnsynchronised;
  EXPECT_EQ(judge(clock).verdict, Verdict::kWarn);
}

TEST(DoctorOnHost, AFolderMustBeWritableAndHaveRoom) {
  FolderFacts folder{"recordings", "/var/lib/ols", 0, 5e9, 1e9};
  EXPECT_EQ(line(judge(folder)), "ok    disk: recordings /var/lib/ols, 5.0 GB free");
  folder.free_bytes = 5e8;
  EXPECT_EQ(judge(folder).verdict, Verdict::kWarn);
  folder.error = EROFS;
  EXPECT_EQ(judge(folder).verdict, Verdict::kFail);
}

TEST(DoctorOnHost, AHotProcessorIsTold) {
  station::HostReport host;
  EXPECT_TRUE(judge(host).empty());
  host.readings["cpu_degC"] = 61.0;
  EXPECT_EQ(exit_status(judge(host)), 0);
  host.alarms = {alarm::processor_hot(92.0)};
  EXPECT_EQ(exit_status(judge(host)), 1);
}

TEST(DoctorOnHost, ReadsTheServiceManager) {
  const auto units = parse_units(
      "Id=ols-bus.service\nLoadState=loaded\nActiveState=active\nSubState=exited\n"
      "Result=success\nNRestarts=0\nStatusText=\n"
      "\n"
      "NRestarts=3\nId=ols-station@alfa.service\nLoadState=loaded\nActiveState=active\n"
      "SubState=running\nStatusText=tracking; x=1\n"
      "\n"
      "Id=ols-fusion.service\nLoadState=loaded\nActiveState=failed\nResult=watchdog\n"
      "\n"
      "Id=ols-logger.service\nLoadState=not-found\nActiveState=inactive\n");
  ASSERT_EQ(units.size(), 4U);
  EXPECT_EQ(line(*judge(units[0])), "ok    service: ols-bus.service active");
  EXPECT_THAT(line(*judge(units[1])), HasSubstr("tracking; x=1, started again 3 times"));
  EXPECT_EQ(judge(units[2])->verdict, Verdict::kFail);
  EXPECT_THAT(line(*judge(units[2])), HasSubstr("(watchdog)"));
  EXPECT_FALSE(judge(units[3]).has_value());
  EXPECT_TRUE(parse_units("").empty());
}

TEST(DoctorOnHost, ReadsRoutes) {
  EXPECT_EQ(parse_route("multicast 239.255.76.67 dev eth0 src 10.0.0.5 uid 0 \\    cache"), "eth0");
  EXPECT_EQ(parse_route("RTNETLINK answers: Network is unreachable"), "");
}

}  // namespace
}  // namespace ols::doctor
