#include "tools/ctl/fleet_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>
#include <vector>

#include "ols_msg/bearing_t.hpp"

namespace ols::ctl {
namespace {

using ols_msg::station_status_t;
using testing::EndsWith;
using testing::HasSubstr;

station_status_t well() {
  station_status_t s{};
  s.utime = 1'700'000'000'000'000;
  s.state = station_status_t::STATE_TRACKING;
  s.clock_state = ols_msg::bearing_t::CLOCK_SYNCHRONISED;
  s.clock_error_s = 2.5e-4;
  s.calibration_state = station_status_t::CALIBRATION_IN_USE;
  s.calibration_utime = s.utime - std::int64_t{5} * 86'400'000'000;
  s.device_name = {"camera", "software"};
  s.device_text = {"Mako", "0.1.0"};
  s.reading_name = {"cpu_degC", "disk_free_bytes"};
  s.reading_value = {51.2, 12.34e9};
  return s;
}

std::vector<std::string> lines(const std::string& table) {
  std::istringstream in(table);
  std::vector<std::string> result;
  for (std::string line; std::getline(in, line);) result.push_back(line);
  return result;
}

TEST(FleetTable, AStationThatIsWell) {
  const auto table = lines(fleet_table({{"alfa", well()}}));
  ASSERT_EQ(table.size(), 2U);
  EXPECT_THAT(table[1], testing::StartsWith("alfa "));
  for (const char* part : {"tracking", " 0.1.0 ", "in use, 5 d", "0.25 ms", "12.3 GB", "51 degC"}) {
    EXPECT_THAT(table[1], HasSubstr(part));
  }
  EXPECT_THAT(table[1], EndsWith(" -"));
}

TEST(FleetTable, AStationThatIsNotHeardHasALine) {
  const auto table = lines(fleet_table({{"bravo", well()}}, {"alfa", "bravo"}));
  ASSERT_EQ(table.size(), 3U);
  EXPECT_THAT(table[1], testing::StartsWith("bravo "));
  EXPECT_THAT(table[2], testing::MatchesRegex("alfa +not heard[ -]+"));
}

TEST(FleetTable, WhatIsWrongIsSaid) {
  station_status_t s{};
  s.utime = well().utime;
  s.calibration_state = station_status_t::CALIBRATION_DOUBTED;
  s.calibration_utime = s.utime - 600'000'000;
  s.alarm = {"ptu: no reply", "clock: no source"};
  const auto table = lines(fleet_table({{"alfa", well()}, {"bravo", s}}));
  ASSERT_EQ(table.size(), 3U);
  EXPECT_THAT(table[2], HasSubstr("doubted, 10 min"));
  EXPECT_THAT(table[2], HasSubstr("not synchronised"));
  EXPECT_THAT(table[2], EndsWith("clock: no source (and 1 more)"));
  s.alarm.clear();
  s.last_error = "ptu: no reply";
  s.last_error_utime = s.utime - 180'000'000;
  EXPECT_THAT(fleet_table({{"bravo", s}}), HasSubstr("ptu: no reply (3 min ago, over)"));
  s.calibration_state = station_status_t::CALIBRATION_REFUSED;
  EXPECT_THAT(fleet_table({{"bravo", s}}), HasSubstr("refused"));
}

}  // namespace
}  // namespace ols::ctl
