#include "base/journal/alarm_changes.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace ols {
namespace {

std::vector<std::string> looked(AlarmChanges& alarms, const std::vector<std::string>& now) {
  std::vector<std::string> found;
  for (const auto& change : alarms.look(alarms_of(now))) {
    found.push_back((change.begins ? "+" : "-") + change.alarm.text);
  }
  return found;
}
using Texts = std::vector<std::string>;

TEST(AlarmChanges, AreThoseThatBeginAndThoseThatEnd) {
  AlarmChanges alarms;
  EXPECT_EQ(looked(alarms, {"gnss: silent for 5 s, position kept", "bus: a flood"}),
            (Texts{"+gnss: silent for 5 s, position kept", "+bus: a flood"}));
  EXPECT_EQ(looked(alarms, {"gnss: silent for 61 s, position kept"}), (Texts{"-bus: a flood"}));
  EXPECT_EQ(looked(alarms, {}), (Texts{"-gnss: silent for 61 s, position kept"}));
}

TEST(AlarmChanges, OneStationIsNotAnother) {
  AlarmChanges alarms;
  EXPECT_EQ(looked(alarms, {"station s1: not used, it reports a clock error of 3 s",
                            "station s2: not used, it reports a clock error of 3 s"})
                .size(),
            2U);
  EXPECT_EQ(looked(alarms, {"station s2: not used, it reports a clock error of 3 s"}),
            (Texts{"-station s1: not used, it reports a clock error of 3 s"}));
}

TEST(AlarmChanges, AnotherNewestCauseIsNoOtherAlarm) {
  AlarmChanges alarms;
  EXPECT_EQ(looked(alarms, {"trust: messages not believed: 7 unsigned; the last: A"}).size(), 1U);
  EXPECT_EQ(looked(alarms, {"trust: messages not believed: 9 unsigned; the last: B"}), Texts{});
}

TEST(AlarmChanges, HaveTheSameKeyWhenTheyBeginAndEnd) {
  AlarmChanges alarms;
  const auto begun = alarms.look(alarms_of({"computer: processor at 91 C"}));
  const auto ended = alarms.look({});
  ASSERT_EQ(begun.size(), 1U);
  ASSERT_EQ(ended.size(), 1U);
  EXPECT_EQ(begun[0].key, ended[0].key);
}

}  // namespace
}  // namespace ols
