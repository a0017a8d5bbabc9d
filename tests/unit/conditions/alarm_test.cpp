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
  EXPECT_EQ(alarm_of("disk 1 on fire").key(), "disk 1 on fire");
  EXPECT_EQ(alarm_of("disk 1 on fire").row().severity, "warning");
  EXPECT_EQ(alarm_of("").id, "");
}

TEST(Alarm, IsTheSameByItsSubjectWhateverElseChanges) {
  EXPECT_EQ(alarm_of(alarm::ptu_supply_low(11.5)).key(),
            alarm_of(alarm::ptu_supply_low(11.4)).key());
  EXPECT_EQ(alarm_of(alarm::gnss_silent("59 s", "position kept")).key(),
            alarm_of(alarm::gnss_silent("2 min", "position kept")).key());
  EXPECT_NE(alarm_of(alarm::station_ahead("s1", 3.0)).key(),
            alarm_of(alarm::station_ahead("s2", 3.0)).key());
  EXPECT_NE(alarm_of(alarm::view_changed(1)).key(), alarm_of(alarm::view_changed(2)).key());
  EXPECT_NE(alarm_of(alarm::commands_refused(3, "slews", 10, "stale")).key(),
            alarm_of(alarm::commands_refused(3, "slews", 10, "replayed")).key());
}

TEST(Alarm, KeepsItsSubjectInItsGist) {
  EXPECT_EQ(alarm_of(alarm::station_ahead("s1", 3.0)).gist(),
            "station s1: not used, its stamps are … s ahead of the others'");
}

struct Status {
  int alarms = 0, alarm_ids = 0, alarm_parameters = 0;
  std::vector<std::string> alarm, alarm_id, alarm_parameter_name, alarm_parameter_value;
  std::vector<std::int16_t> alarm_parameter_of;
};

// A program of another version has other words for it.
TEST(Alarm, IsInAMessageByItsIdWhateverItsWords) {
  Status status;
  set_alarms({alarm::image_too_dark(), alarm::station_ahead("s1", 3.0)}, status);
  status.alarm[1] = "s1 lives in the future";
  const std::vector<Alarm> alarms = alarms_of(status);
  ASSERT_EQ(alarms.size(), 2U);
  EXPECT_EQ(alarms[0].key(), "image_too_dark");
  EXPECT_EQ(alarms[1].key(), "station_ahead s1");
}

TEST(Alarm, OfALogOfBeforeIsFoundByItsWords) {
  Status status;
  status.alarm = {alarm::station_ahead("s1", 3.0)};
  EXPECT_EQ(alarms_of(status).at(0).key(), "station_ahead s1");
}

TEST(Alarm, OfAForgedMessageTakesNoParametersOfNobody) {
  Status status;
  set_alarms({alarm::station_ahead("s1", 3.0)}, status);
  status.alarm_parameter_of = {-1, 7};
  EXPECT_TRUE(alarms_of(status).at(0).parameters.empty());
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
