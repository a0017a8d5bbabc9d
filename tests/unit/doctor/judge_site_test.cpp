#include "tools/doctor/judge_site.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cerrno>

namespace ols::doctor {
namespace {

using testing::HasSubstr;

std::string lines(const Findings& findings) {
  std::string text;
  for (const Finding& finding : findings) text += line(finding) + "\n";
  return text;
}

BusHeard good_bus() {
  BusHeard bus;
  bus.url = "udpm://239.255.76.67:7667?ttl=1";
  bus.interface = "eth0";
  bus.ttl = 1;
  bus.rmem_max = 16 << 20;
  bus.stations["alfa"].state = "idle";
  bus.stations["bravo"].state = "tracking";
  bus.fusions = 1;
  return bus;
}

TEST(DoctorOnSite, AWellBusWithCompany) {
  EXPECT_EQ(exit_status(judge(good_bus())), 0);
  const Findings company = judge_company(good_bus(), "alfa");
  EXPECT_EQ(exit_status(company), 0);
  EXPECT_EQ(lines(company), "ok    stations: bravo (tracking)\nok    fusion: heard\n");
}

TEST(DoctorOnSite, ABusThatReachesNobodyElseIsTold) {
  BusHeard bus = good_bus();
  bus.interface = "lo";
  EXPECT_THAT(lines(judge(bus)), HasSubstr("does not reach other hosts"));
  bus.ttl = 0;  // meant to stay on this host
  EXPECT_EQ(exit_status(judge(bus)), 0);
  bus.interface = "eth0";
  EXPECT_THAT(lines(judge(bus)), HasSubstr("write ttl=1"));
  bus.trouble = "no route";
  EXPECT_EQ(exit_status(judge(bus)), 2);
}

TEST(DoctorOnSite, SmallBuffersLonelinessAndRivalsAreTold) {
  BusHeard bus = good_bus();
  bus.rmem_max = 212992;
  EXPECT_THAT(lines(judge(bus)), HasSubstr("60-ols.conf"));
  bus.stations.erase("bravo");
  bus.fusions = 0;
  EXPECT_EQ(exit_status(judge_company(bus, "alfa")), 1);
  bus.fusions = 2;
  EXPECT_EQ(exit_status(judge_company(bus, "alfa")), 2);
}

TEST(DoctorOnSite, TheFusionsAlarmsAreTold) {
  BusHeard bus = good_bus();
  bus.fusion_alarms = {"another fusion is on the bus: stop one of them"};
  EXPECT_EQ(exit_status(judge_company(bus, "alfa")), 1);
  EXPECT_THAT(lines(judge_company(bus, "alfa")), HasSubstr("fusion: alarm: another fusion is"));
}

StationHeard good_station() {
  StationHeard station;
  station.id = "alfa";
  station.state = "tracking";
  station.devices.resize(1);
  station.devices[0].name = "camera";
  station.devices[0].state = device::DeviceState::kOk;
  station.clock = clock::ClockState::kSynchronised;
  station.clock_error_s = 2e-4;
  station.counters = {{"frames_captured", 1000.0}, {"frames_lost", 5.0}};
  return station;
}

TEST(DoctorOnSite, AWellStation) {
  EXPECT_EQ(exit_status(judge(good_station())), 0) << lines(judge(good_station()));
  EXPECT_THAT(lines(judge(good_station())), HasSubstr("frames: 1000, 0.50 % lost"));
}

TEST(DoctorOnSite, WhatAStationComplainsOfIsPassedOn) {
  StationHeard station = good_station();
  station.alarms = {"gnss: 103 m from the survey"};
  EXPECT_THAT(lines(judge(station)), HasSubstr("warn  alarm: gnss: 103 m from the survey"));
  station = good_station();
  station.counters["frames_incomplete"] = 20.0;
  EXPECT_EQ(exit_status(judge(station)), 1);
  station = good_station();
  station.clock = clock::ClockState::kUnsynchronised;
  EXPECT_EQ(exit_status(judge(station)), 1);
  station = good_station();
  station.devices[0].state = device::DeviceState::kAbsent;
  EXPECT_EQ(exit_status(judge(station)), 2);
  station = good_station();
  station.position_known = false;
  EXPECT_EQ(exit_status(judge(station)), 2);
  station = good_station();
  station.boots = 2;
  EXPECT_EQ(exit_status(judge(station)), 2);
}

TEST(DoctorOnSite, AnOldErrorIsForgotten) {
  StationHeard station = good_station();
  station.last_error = "ptu: no answer";
  station.last_error_age_s = 10.0;
  EXPECT_EQ(exit_status(judge(station)), 1);
  station.last_error_age_s = 600.0;
  EXPECT_EQ(exit_status(judge(station)), 0);
}

TEST(DoctorOnSite, AClockIsNeverAReasonToStop) {
  clock::ClockQuality clock;
  clock.text = "chrony: PPS";
  clock.state = clock::ClockState::kSynchronised;
  EXPECT_EQ(judge(clock).verdict, Verdict::kOk);
  clock.alarm = "clock: stepped by +2.000 s 12 s ago";
  EXPECT_EQ(judge(clock).verdict, Verdict::kWarn);
  clock.state = clock::ClockState::kUnsynchronised;
  EXPECT_EQ(judge(clock).verdict, Verdict::kWarn);
}

TEST(DoctorOnSite, AFolderMustBeWritableAndHaveRoom) {
  FolderFacts folder{"recordings", "/var/lib/ols", 0, 5e9, 1e9};
  EXPECT_EQ(line(judge(folder)), "ok    disk: recordings /var/lib/ols, 5.0 GB free");
  folder.free_bytes = 5e8;
  EXPECT_EQ(judge(folder).verdict, Verdict::kWarn);
  folder.error = EROFS;
  EXPECT_EQ(judge(folder).verdict, Verdict::kFail);
}

TEST(DoctorOnSite, AHotProcessorIsTold) {
  station::HostReport host;
  EXPECT_TRUE(judge(host).empty());
  host.readings["cpu_degC"] = 61.0;
  EXPECT_EQ(exit_status(judge(host)), 0);
  host.alarms = {"processor at 92 degC"};
  EXPECT_EQ(exit_status(judge(host)), 1);
}

TEST(DoctorOnSite, ReadsTheServiceManager) {
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

TEST(DoctorOnSite, ReadsRoutes) {
  EXPECT_EQ(parse_route("multicast 239.255.76.67 dev eth0 src 10.0.0.5 uid 0 \\    cache"), "eth0");
  EXPECT_EQ(parse_route("RTNETLINK answers: Network is unreachable"), "");
}

}  // namespace
}  // namespace ols::doctor
