#include "edge/command/refusal_log.h"

#include <gtest/gtest.h>

namespace ols::station {
namespace {

TEST(RefusalLog, CountsWhatIsRefusedAndTellsTheLastInWords) {
  RefusalLog log;
  EXPECT_EQ(log.number(), 0U);
  log.refuse("SLEW", "schema");
  log.refuse("PTU", "malformed");
  log.note("DESIGNATE refused: tracker");
  EXPECT_EQ(log.last(), "DESIGNATE refused: tracker");
  EXPECT_EQ(log.number(), 3U);
  EXPECT_EQ(log.counters().at("messages_refused"), 2.0) << "the station's own refusals it counts";
  EXPECT_EQ(log.counters().at("messages_refused_schema"), 1.0);
  EXPECT_TRUE(log.alarms(10.0).empty());
}

TEST(RefusalLog, CommandsThatAreNotFreshAgainAndAgainAreAnAlarm) {
  RefusalLog log;
  for (int i = 0; i < 3; ++i) log.refuse_at_gate("SLEW", "stale", 10.0);
  EXPECT_EQ(log.alarms(10.0), std::vector<std::string>{"commands: 3 slews refused in 10 s: stale"});
  EXPECT_EQ(log.counters().at("messages_refused_stale"), 3.0);
  EXPECT_EQ(log.last(), "") << "the alarm says it";
}

}  // namespace
}  // namespace ols::station
