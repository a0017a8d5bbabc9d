#include "base/journal/alarm_changes.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "conditions/alarms.h"

namespace ols {
namespace {

std::vector<std::string> looked(AlarmChanges& alarms, const std::vector<Alarm>& now) {
  std::vector<std::string> found;
  for (const auto& change : alarms.look(now)) {
    found.push_back((change.begins ? "+" : "-") + change.alarm.text);
  }
  return found;
}
using Texts = std::vector<std::string>;

TEST(AlarmChanges, AreThoseThatBeginAndThoseThatEnd) {
  AlarmChanges alarms;
  EXPECT_EQ(looked(alarms, {alarm::gnss_silent("5 s", "position kept"), {"bus: a flood"}}),
            (Texts{"+gnss: silent for 5 s, position kept", "+bus: a flood"}));
  EXPECT_EQ(looked(alarms, {alarm::gnss_silent("61 s", "position kept")}),
            (Texts{"-bus: a flood"}));
  EXPECT_EQ(looked(alarms, {}), (Texts{"-gnss: silent for 61 s, position kept"}));
}

TEST(AlarmChanges, OneStationIsNotAnother) {
  AlarmChanges alarms;
  EXPECT_EQ(
      looked(alarms, {alarm::station_clock_error("s1", 3.0), alarm::station_clock_error("s2", 3.0)})
          .size(),
      2U);
  EXPECT_EQ(looked(alarms, {alarm::station_clock_error("s2", 3.0)}),
            (Texts{"-station s1: not used, it reports a clock error of 3 s"}));
}

TEST(AlarmChanges, AnotherNewestCauseIsNoOtherAlarm) {
  AlarmChanges alarms;
  EXPECT_EQ(looked(alarms, {alarm::messages_not_believed("7 unsigned", "A")}).size(), 1U);
  EXPECT_EQ(looked(alarms, {alarm::messages_not_believed("9 unsigned", "B")}), Texts{});
}

TEST(AlarmChanges, HaveTheSameKeyWhenTheyBeginAndEnd) {
  AlarmChanges alarms;
  const auto begun = alarms.look({alarm::processor_hot(91.0)});
  const auto ended = alarms.look({});
  ASSERT_EQ(begun.size(), 1U);
  ASSERT_EQ(ended.size(), 1U);
  EXPECT_EQ(begun[0].key, ended[0].key);
}

}  // namespace
}  // namespace ols
