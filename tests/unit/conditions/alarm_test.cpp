#include "conditions/alarm.h"

#include <gtest/gtest.h>

#include "conditions/alarm_json.h"
#include "conditions/alarm_rows.h"
#include "conditions/alarms.h"

namespace ols {
namespace {

TEST(Alarm, HasItsSentenceAndItsParameters) {
  const Alarm alarm = alarm::station_off_calibration("s2", 31.4, -2.0);
  EXPECT_EQ(alarm.id, "station_off_calibration");
  EXPECT_EQ(
      alarm.parameters,
      (Alarm::Parameters{{"station", "s2"}, {"across_arcsec", "31"}, {"elevation_arcsec", "-2"}}));
  EXPECT_EQ(alarm::ptu_supply_low(11.54), "ptu: supply voltage low (11.5 V)");
}

TEST(Alarm, IsAboutAPart) {
  const Alarm alarm = alarm::station_ahead("s: 1", 3.0);
  EXPECT_EQ(alarm.part(), "station s: 1");
  EXPECT_EQ(alarm.reason(), "not used, its stamps are 3 s ahead of the others'");
  EXPECT_EQ(alarm::fusion_silent().part(), "");
  EXPECT_EQ(alarm::fusion_silent().reason(), alarm::fusion_silent().text);
}

TEST(Alarm, GoesOnWithTheWordsOfADevice) {
  const Alarm alarm = alarm::camera_refuses("Gain").with_detail("out of range");
  EXPECT_EQ(alarm, "camera: refuses Gain: out of range");
  EXPECT_EQ(alarm.parameter("detail"), "out of range");
  EXPECT_EQ(alarm.reason(), "refuses Gain: out of range");
}

TEST(Alarm, WithoutAnIdIsItsOwnKey) {
  const Alarm alarm{"disk 1 on fire"};
  EXPECT_EQ(alarm.key(), "disk 1 on fire");
  EXPECT_EQ(alarm.row().severity, "warning");
  EXPECT_EQ(alarm.part(), "");
  EXPECT_EQ(alarm.reason(), "disk 1 on fire");
}

TEST(Alarm, IsTheSameByItsSubjectWhateverElseChanges) {
  EXPECT_EQ(alarm::ptu_supply_low(11.5).key(), alarm::ptu_supply_low(11.4).key());
  EXPECT_EQ(alarm::gnss_silent("59 s", "position kept").key(),
            alarm::gnss_silent("2 min", "position kept").key());
  EXPECT_NE(alarm::station_ahead("s1", 3.0).key(), alarm::station_ahead("s2", 3.0).key());
  EXPECT_NE(alarm::view_changed(1).key(), alarm::view_changed(2).key());
  EXPECT_NE(alarm::commands_refused(3, "slews", 10, "stale").key(),
            alarm::commands_refused(3, "slews", 10, "replayed").key());
}

TEST(Alarm, KeepsItsSubjectInItsGist) {
  EXPECT_EQ(alarm::station_ahead("s1", 3.0).gist(),
            "station s1: not used, its stamps are … s ahead of the others'");
}

TEST(Alarm, IsTheSameInAStatusFile) {
  const Alarm alarm = alarm::tripod_moved(52.0, 3.0, "calibrate its setup again");
  EXPECT_EQ(nlohmann::json(alarm).get<Alarm>().key(), alarm.key());
  EXPECT_EQ(nlohmann::json(alarm).get<Alarm>().text, alarm.text);
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

TEST(Alarm, OfALogOfBeforeIsItsSentence) {
  Status status;
  status.alarm = {"camera: does not answer"};
  ASSERT_EQ(alarms_of(status).size(), 1U);
  EXPECT_EQ(alarms_of(status).front(), Alarm{"camera: does not answer"});
}

TEST(Alarm, OfAForgedMessageTakesNoParametersOfNobody) {
  Status status;
  set_alarms({alarm::station_ahead("s1", 3.0)}, status);
  status.alarm_parameter_of = {-1, 7};
  EXPECT_TRUE(alarms_of(status).at(0).parameters.empty());
}

}  // namespace
}  // namespace ols
