#include "base/journal/journal_event.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace ols {
namespace {

using Fields = std::vector<std::string>;

TEST(JournalEvent, HasTheFieldsThatItFills) {
  EXPECT_EQ(journal_fields({.text = "bus: a\nb", .bad = true}),
            (Fields{"MESSAGE=bus: a\nb", "PRIORITY=4"}));
  EXPECT_EQ(
      journal_fields({.text = "ptu ok",
                      .id = event::kDeviceWorks,
                      .station = "alfa",
                      .device = "ptu",
                      .reason = "ok"}),
      (Fields{"MESSAGE=ptu ok", "PRIORITY=6", "MESSAGE_ID=" + std::string(event::kDeviceWorks),
              "OLS_STATION=alfa", "OLS_DEVICE=ptu", "OLS_REASON=ok"}));
}

TEST(JournalEvent, AnAlarmIsAboutAStationOrAPart) {
  const JournalEvent of_station = alarm_event(alarm_of("station s2: not used, late: 3 s"), true);
  EXPECT_EQ(of_station.text, "alarm: station s2: not used, late: 3 s");
  EXPECT_TRUE(of_station.bad);
  EXPECT_EQ(of_station.id, event::kAlarmBegins);
  EXPECT_EQ(of_station.station, "s2");
  EXPECT_EQ(of_station.device, "");
  EXPECT_EQ(of_station.reason, "not used, late: 3 s");
  const JournalEvent of_part = alarm_event(alarm_of("bus: a flood"), false);
  EXPECT_EQ(of_part.text, "over: bus: a flood");
  EXPECT_FALSE(of_part.bad);
  EXPECT_EQ(of_part.id, event::kAlarmEnds);
  EXPECT_EQ(of_part.station, "");
  EXPECT_EQ(of_part.device, "bus");
  EXPECT_EQ(alarm_event(alarm_of("another fusion runs"), true).reason, "another fusion runs");
}

TEST(JournalEvent, AStationsAlarmIsAboutItsOwnParts) {
  EXPECT_EQ(station_alarm_event(alarm_of("gnss: silent"), true).id, event::kStationAlarmBegins);
  EXPECT_EQ(station_alarm_event(alarm_of("gnss: silent"), true).device, "gnss");
  EXPECT_EQ(station_alarm_event(alarm_of("gnss: silent"), false).id, event::kStationAlarmEnds);
}

}  // namespace
}  // namespace ols
