#include "base/journal/journal.h"

#include <gtest/gtest.h>
#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/spdlog.h>

#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "base/journal/alarm_journal.h"
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

TEST(Journal, KnowsItsStream) {
  EXPECT_TRUE(names_stream("9:4711", 9, 4711));
  EXPECT_FALSE(names_stream("9:4711", 9, 47));
  EXPECT_FALSE(names_stream("8:4711", 9, 4711));
  EXPECT_FALSE(names_stream("", 0, 0));
}

TEST(Journal, IsALineOfTheLogWhereTheJournalDoesNotListen) {
  std::ostringstream said;
  const auto before = spdlog::default_logger();
  const auto sink = std::make_shared<spdlog::sinks::ostream_sink_mt>(said);
  const auto logger = std::make_shared<spdlog::logger>("test", sink);
  logger->set_pattern("%l %v");
  spdlog::set_default_logger(logger);
  write_to_journal({.text = "gnss {lost}", .bad = true, .id = event::kDeviceLost});
  write_to_journal({.text = "gnss ok"});
  spdlog::set_default_logger(before);
  EXPECT_EQ(said.str(), "warning gnss {lost}\ninfo gnss ok\n");
}

}  // namespace
}  // namespace ols
