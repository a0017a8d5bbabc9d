#include "base/journal/journal_event.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "conditions/alarms.h"

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
  const JournalEvent of_station = alarm_event(alarm::station_behind("s2", 3.0), true);
  EXPECT_EQ(of_station.text, "alarm: station s2: not used, its stamps are 3 s behind the others'");
  EXPECT_TRUE(of_station.bad);
  EXPECT_EQ(of_station.id, event::kAlarmBegins);
  EXPECT_EQ(of_station.station, "s2");
  EXPECT_EQ(of_station.device, "");
  EXPECT_EQ(of_station.reason, "not used, its stamps are 3 s behind the others'");
  const JournalEvent of_part = alarm_event(alarm::bus_flooded(1, 2, 3), false);
  EXPECT_EQ(of_part.text, "over: " + alarm::bus_flooded(1, 2, 3).text);
  EXPECT_FALSE(of_part.bad);
  EXPECT_EQ(of_part.id, event::kAlarmEnds);
  EXPECT_EQ(of_part.station, "");
  EXPECT_EQ(of_part.device, "bus");
  EXPECT_EQ(alarm_event(alarm::fusion_silent(), true).reason, alarm::fusion_silent().text);
  EXPECT_EQ(alarm_event({"of a log of before"}, true).reason, "of a log of before");
}

TEST(JournalEvent, AStationsAlarmIsAboutItsOwnParts) {
  EXPECT_EQ(station_alarm_event(alarm::gnss_silent("5 s", "position kept"), true).id,
            event::kStationAlarmBegins);
  EXPECT_EQ(station_alarm_event(alarm::gnss_silent("5 s", "position kept"), true).device, "gnss");
  EXPECT_EQ(station_alarm_event(alarm::gnss_silent("5 s", "position kept"), false).id,
            event::kStationAlarmEnds);
}

}  // namespace
}  // namespace ols
