#include "base/alarm_changes.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace ols {
namespace {

std::vector<std::string> looked(AlarmChanges& alarms, const std::vector<std::string>& now) {
  std::vector<std::string> found;
  for (const auto& change : alarms.look(now)) {
    found.push_back((change.begins ? "+" : "-") + change.alarm);
  }
  return found;
}
using Texts = std::vector<std::string>;

TEST(AlarmChanges, AreThoseThatBeginAndThoseThatEnd) {
  AlarmChanges alarms;
  EXPECT_EQ(looked(alarms, {"gnss: silent for 5 s", "bus: a flood"}),
            (Texts{"+gnss: silent for 5 s", "+bus: a flood"}));
  EXPECT_EQ(looked(alarms, {"gnss: silent for 61 s"}), (Texts{"-bus: a flood"}));
  EXPECT_EQ(looked(alarms, {}), (Texts{"-gnss: silent for 61 s"}));
}

TEST(AlarmChanges, OneStationIsNotAnother) {
  AlarmChanges alarms;
  EXPECT_EQ(looked(alarms, {"station s1: not used", "station s2: not used"}).size(), 2U);
  EXPECT_EQ(looked(alarms, {"station s2: not used"}), (Texts{"-station s1: not used"}));
}

TEST(AlarmChanges, AnotherNewestCauseIsNoOtherAlarm) {
  AlarmChanges alarms;
  EXPECT_EQ(looked(alarms, {"bus: 7 messages are refused; the last: A: unsigned"}).size(), 1U);
  EXPECT_EQ(looked(alarms, {"bus: 9 messages are refused; the last: B: unsigned"}), Texts{});
  EXPECT_EQ(looked(alarms, {"trust: refused; A"}).size(), 2U);
  EXPECT_EQ(looked(alarms, {"trust: refused; B"}), Texts{});
}

TEST(AlarmChanges, HaveTheSameKeyWhenTheyBeginAndEnd) {
  AlarmChanges alarms;
  const auto begun = alarms.look({"clock: 3 s wrong"});
  const auto ended = alarms.look({});
  ASSERT_EQ(begun.size(), 1U);
  ASSERT_EQ(ended.size(), 1U);
  EXPECT_EQ(begun[0].key, ended[0].key);
}

}  // namespace
}  // namespace ols
