#include "edge/command/refusal_log.h"

#include <gtest/gtest.h>

#include "conditions/alarms.h"

namespace ols::station {
namespace {

TEST(RefusalLog, CountsWhatIsRefusedAndTellsTheLastInWords) {
  RefusalLog log;
  EXPECT_EQ(log.number(), 0U);
  log.refuse("SLEW", "schema");
  log.refuse("PTU", "malformed");
  EXPECT_EQ(log.last(), "PTU refused: the message is damaged, or of another version");
  log.note("RECORD refused: disk full");
  EXPECT_EQ(log.last(), "RECORD refused: disk full");
  EXPECT_EQ(log.number(), 3U);
  EXPECT_EQ(log.counters().at("messages_refused"), 2.0) << "the station's own refusals it counts";
  EXPECT_EQ(log.counters().at("messages_refused_schema"), 1.0);
  EXPECT_TRUE(log.alarms(10.0).empty());
}

TEST(RefusalLog, CommandsThatAreNotFreshAgainAndAgainAreAnAlarm) {
  RefusalLog log;
  for (int i = 0; i < 3; ++i) log.refuse_at_gate("SLEW", "stale", 10.0);
  EXPECT_EQ(log.alarms(10.0), std::vector{alarm::commands_refused(3, "slews", 10, "stale")});
  EXPECT_EQ(log.counters().at("messages_refused_stale"), 3.0);
  EXPECT_EQ(log.last(), "") << "the alarm says it";
}

}  // namespace
}  // namespace ols::station
