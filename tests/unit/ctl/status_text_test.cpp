#include "tools/ctl/status_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace ols::ctl {
namespace {

using testing::HasSubstr;
using testing::Not;

ols_msg::station_status_t tracking() {
  ols_msg::station_status_t status{};
  status.station = "alfa";
  status.state = ols_msg::station_status_t::STATE_TRACKING;
  status.belief = 0.9;
  status.heading_rad = std::numeric_limits<double>::quiet_NaN();
  status.last_error = "camera lost";
  status.last_error_utime = 5'000'000;
  return status;
}

TEST(StatusText, ATableHasALineForEachStation) {
  const std::string table = status_table({{"alfa", tracking()}, {"bravo", tracking()}});
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 3);
  EXPECT_THAT(table, HasSubstr("\nalfa         tracking    0.90"));
}

TEST(StatusText, WhatIsNotKnownIsADash) {
  EXPECT_THAT(full_status(tracking(), 0), HasSubstr("heading    - +- 0.0000 deg"));
}

TEST(StatusText, TheLastErrorHasItsAge) {
  EXPECT_THAT(full_status(tracking(), 12'000'000), HasSubstr("last error, 7 s ago: camera lost"));
}

TEST(StatusText, AHiddenTargetIsSaidForHowLong) {
  ols_msg::station_status_t status = tracking();
  status.state = ols_msg::station_status_t::STATE_HIDDEN;
  status.hidden_since_utime = 8'000'000;
  EXPECT_THAT(full_status(status, 12'000'000), HasSubstr("hidden     for 4 s\n"));
  status.hidden_until_utime = 15'000'000;
  EXPECT_THAT(full_status(status, 12'000'000),
              HasSubstr("hidden     for 4 s, expected back in 3 s\n"));
}

TEST(StatusText, OfManyAlarmsSixteenAreShown) {
  ols_msg::station_status_t status = tracking();
  EXPECT_THAT(full_status(status, 0), HasSubstr("no alarm\n"));
  status.alarm.assign(20, "dust");
  status.alarm[16] = "fire";
  const std::string text = full_status(status, 0);
  EXPECT_THAT(text, HasSubstr("  and 4 more\n"));
  EXPECT_THAT(text, Not(HasSubstr("fire")));
}

}  // namespace
}  // namespace ols::ctl
