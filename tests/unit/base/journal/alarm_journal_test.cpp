#include "base/journal/alarm_journal.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace ols {
namespace {

// The same condition, whatever its number.
const std::string k3s = "station bravo: not used, its stamps are 3 s behind the others'";
const std::string k4s = "station bravo: not used, its stamps are 4 s behind the others'";

TEST(AlarmJournal, TellsWhatBeginsAndEndsAndIsNotFlooded) {
  std::vector<JournalEvent> told;
  AlarmJournal journal([&told](const JournalEvent& event) { told.push_back(event); });
  journal.look({k3s}, 0.0);
  journal.look({k4s}, 1.0);
  journal.look({}, 2.0);
  ASSERT_EQ(told.size(), 2U);
  EXPECT_EQ(told[0].text, "alarm: " + k3s);
  EXPECT_EQ(told[0].station, "bravo");
  EXPECT_EQ(told[1].text, "over: " + k4s);
  EXPECT_EQ(told[1].id, event::kAlarmEnds);
  for (int i = 0; i < 20; ++i) {
    journal.look({k4s}, 3.0);
    journal.look({}, 4.0);
  }
  EXPECT_EQ(told.size(), 4U);
}

}  // namespace
}  // namespace ols
