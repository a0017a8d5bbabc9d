#include "base/alarm_journal.h"

#include <gtest/gtest.h>

#include <vector>

namespace ols {
namespace {

TEST(AlarmJournal, TellsWhatBeginsAndEndsAndIsNotFlooded) {
  std::vector<JournalEvent> told;
  AlarmJournal journal([&told](const JournalEvent& event) { told.push_back(event); });
  journal.look({"station bravo: not used, 3 s late"}, 0.0);
  journal.look({"station bravo: not used, 4 s late"}, 1.0);
  journal.look({}, 2.0);
  ASSERT_EQ(told.size(), 2U);
  EXPECT_EQ(told[0].text, "alarm: station bravo: not used, 3 s late");
  EXPECT_EQ(told[0].station, "bravo");
  EXPECT_EQ(told[1].text, "over: station bravo: not used, 4 s late");
  EXPECT_EQ(told[1].id, event::kAlarmEnds);
  for (int i = 0; i < 20; ++i) {
    journal.look({"station bravo: not used, 4 s late"}, 3.0);
    journal.look({}, 4.0);
  }
  EXPECT_EQ(told.size(), 4U);
}

}  // namespace
}  // namespace ols
