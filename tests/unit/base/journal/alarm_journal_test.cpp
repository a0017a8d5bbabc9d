#include "base/journal/alarm_journal.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "conditions/alarms.h"

namespace ols {
namespace {

// The same condition, whatever its number.
const Alarm k3s = alarm::station_behind("bravo", 3.0);
const Alarm k4s = alarm::station_behind("bravo", 4.0);

TEST(AlarmJournal, TellsWhatBeginsAndEndsAndIsNotFlooded) {
  std::vector<JournalEvent> told;
  AlarmJournal journal([&told](const JournalEvent& event) { told.push_back(event); });
  journal.look({k3s}, 0.0);
  journal.look({k4s}, 1.0);
  journal.look({}, 2.0);
  ASSERT_EQ(told.size(), 2U);
  EXPECT_EQ(told[0].text, "alarm: " + k3s.text);
  EXPECT_EQ(told[0].station, "bravo");
  EXPECT_EQ(told[1].text, "over: " + k4s.text);
  EXPECT_EQ(told[1].id, event::kAlarmEnds);
  for (int i = 0; i < 20; ++i) {
    journal.look({k4s}, 3.0);
    journal.look({}, 4.0);
  }
  EXPECT_EQ(told.size(), 4U);
}

}  // namespace
}  // namespace ols
