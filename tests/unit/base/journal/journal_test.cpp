#include "base/journal/journal.h"

#include <gtest/gtest.h>
#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/spdlog.h>

#include <memory>
#include <sstream>

namespace ols {
namespace {

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
