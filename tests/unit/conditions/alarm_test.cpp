#include "conditions/alarm.h"

#include <gtest/gtest.h>

#include <regex>

#include "conditions/alarms.h"

namespace ols {
namespace {

using Parameters = std::vector<std::pair<std::string, std::string>>;

TEST(Alarm, IsFoundInItsSentence) {
  const Alarm alarm = alarm_of(alarm::station_off_calibration("s2", 31.4, -2.0));
  EXPECT_EQ(alarm.id, "station_off_calibration");
  EXPECT_EQ(alarm.parameters,
            (Parameters{{"station", "s2"}, {"across_arcsec", "31"}, {"elevation_arcsec", "-2"}}));
}

TEST(Alarm, MayGoOnBehindItsSentence) {
  const std::string more =
      alarm::tilt_off_survey("0.30 deg") + " for 6 min: set up the station again";
  EXPECT_EQ(alarm_of(more).id, "tilt_off_survey");
  EXPECT_EQ(alarm_of(more).parameters, (Parameters{{"angle", "0.30 deg"}}));
}

TEST(Alarm, ThatTheTableDoesNotHaveIsItsOwnKey) {
  EXPECT_EQ(alarm_of("on fire").id, "");
  EXPECT_EQ(alarm_key("disk 1 on fire"), "disk 1 on fire");
  EXPECT_EQ(alarm_of("").id, "");
}

TEST(Alarm, IsTheSameByItsSubjectWhateverElseChanges) {
  EXPECT_EQ(alarm_key(alarm::ptu_supply_low(11.5)), alarm_key(alarm::ptu_supply_low(11.4)));
  EXPECT_EQ(alarm_key(alarm::gnss_silent("59 s", "position kept")),
            alarm_key(alarm::gnss_silent("2 min", "position kept")));
  EXPECT_NE(alarm_key(alarm::station_ahead("s1", "3.0")),
            alarm_key(alarm::station_ahead("s2", "3.0")));
  EXPECT_NE(alarm_key(alarm::view_changed(1)), alarm_key(alarm::view_changed(2)));
  EXPECT_NE(alarm_key(alarm::commands_refused(3, "slews", 10, "stale")),
            alarm_key(alarm::commands_refused(3, "slews", 10, "replayed")));
}

TEST(Alarm, NoSentenceOfTheTableIsTakenForAnother) {
  const std::regex parameter("\\{\\w+\\}");
  for (const AlarmSentence& one : alarm_sentences()) {
    const std::string english(one.english);
    EXPECT_EQ(alarm_of(std::regex_replace(english, parameter, "7")).id, one.id);
    EXPECT_EQ(alarm_of(std::regex_replace(english, parameter, "not ready: 3 of 4")).id, one.id);
  }
}

}  // namespace
}  // namespace ols
