#include "tools/doctor/judge_site.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "conditions/alarms.h"

namespace ols::doctor {
namespace {

using testing::HasSubstr;

std::string lines(const Findings& findings) {
  std::string text;
  for (const Finding& finding : findings) text += line(finding) + "\n";
  return text;
}

BusFacts good_bus() {
  BusFacts bus;
  bus.url = "udpm://239.255.76.67:7667?ttl=1";
  bus.interface = "eth0";
  bus.ttl = 1;
  bus.rmem_max = 16 << 20;
  bus.stations["alfa"].state = "idle";
  bus.stations["bravo"].state = "tracking";
  bus.fusions = 1;
  bus.is_verified = true;
  return bus;
}

TEST(DoctorOnSite, AWellBusWithCompany) {
  EXPECT_EQ(exit_status(judge(good_bus())), 0);
  const Findings company = judge_company(good_bus(), "alfa");
  EXPECT_EQ(exit_status(company), 0);
  EXPECT_EQ(lines(company), "ok    stations: bravo (tracking)\nok    fusion: heard\n");
}

TEST(DoctorOnSite, ABusThatReachesNobodyElseIsTold) {
  BusFacts bus = good_bus();
  bus.interface = "lo";
  EXPECT_THAT(lines(judge(bus)), HasSubstr("does not reach other hosts"));
  bus.ttl = 0;  // meant to stay on this host
  EXPECT_EQ(exit_status(judge(bus)), 0);
  bus.interface = "eth0";
  EXPECT_THAT(lines(judge(bus)), HasSubstr("write ttl=1"));
  bus.trouble = "no route";
  EXPECT_EQ(exit_status(judge(bus)), 2);
}

TEST(DoctorOnSite, WhatIsNotSignedIsTold) {
  BusFacts bus = good_bus();
  bus.distrusted = {{"bus_distrusted_replayed", 0.0}, {"bus_distrusted_unsigned", 3.0}};
  EXPECT_THAT(lines(judge(bus)), HasSubstr("warn  signatures: not believed just now: 3 unsigned"));
  bus.trust_trouble = alarm::own_key_revoked("alfa");
  EXPECT_EQ(exit_status(judge(bus)), 2);
  bus = good_bus();
  bus.is_verified = false;
  EXPECT_THAT(lines(judge(bus)), HasSubstr("anybody on this network can command"));
  bus.ttl = 0;
  bus.interface = "lo";
  EXPECT_EQ(exit_status(judge(bus)), 0) << "nobody else is on it";
  StationFacts station;
  station.counters = {{"bus_distrusted_stranger", 12.0}};
  EXPECT_THAT(lines(judge(station)), HasSubstr("not believed since its start: 12 stranger"));
}

TEST(DoctorOnSite, SmallBuffersLonelinessAndRivalsAreTold) {
  BusFacts bus = good_bus();
  bus.rmem_max = 212992;
  EXPECT_THAT(lines(judge(bus)), HasSubstr("60-ols.conf"));
  bus.stations.erase("bravo");
  bus.fusions = 0;
  EXPECT_EQ(exit_status(judge_company(bus, "alfa")), 1);
  bus.fusions = 2;
  EXPECT_EQ(exit_status(judge_company(bus, "alfa")), 2);
}

TEST(DoctorOnSite, TheFusionsAlarmsAreTold) {
  BusFacts bus = good_bus();
  bus.fusion_alarms = {alarm::another_fusion()};
  EXPECT_EQ(exit_status(judge_company(bus, "alfa")), 1);
  EXPECT_THAT(lines(judge_company(bus, "alfa")), HasSubstr("fusion: alarm: another fusion is"));
}

StationFacts good_station() {
  StationFacts station;
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
  StationFacts station = good_station();
  station.alarms = {alarm::gnss_off_survey("103 m")};
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
  StationFacts station = good_station();
  station.last_error = "ptu: no answer";
  station.last_error_age_s = 10.0;
  EXPECT_EQ(exit_status(judge(station)), 1);
  station.last_error_age_s = 600.0;
  EXPECT_EQ(exit_status(judge(station)), 0);
}

TEST(JudgeStation, SaysHowWellItIsCalibratedAndSinceWhen) {
  StationFacts station = good_station();
  EXPECT_THAT(lines(judge(station)), testing::Not(HasSubstr("calibration")));
  station.calibration = {true, false, 8.0 * 3.14159265 / 648000.0, 2.5 * 86400.0};
  EXPECT_THAT(lines(judge(station)), HasSubstr("calibration: in use, 8 arc seconds, 2.5 days old"));
  station.calibration.doubted = true;
  EXPECT_THAT(lines(judge(station)), HasSubstr("warn  calibration: in use, 8 arc seconds"));
}

}  // namespace
}  // namespace ols::doctor
