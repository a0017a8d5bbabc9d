#include "sim/ptu/console.h"

#include <gtest/gtest.h>

namespace ols::sim {
namespace {

std::string said(PtuConsole& console, std::string_view line, double now_s) {
  const auto answer = console.take(line, now_s);
  const auto* words = std::get_if<std::string>(&answer);
  return words == nullptr ? "angles" : *words;
}

TEST(PtuConsole, PlansFaultsFromNowOn) {
  PtuConsole console;
  EXPECT_EQ(said(console, "fault line-cut 5", 100.0), "done");
  EXPECT_EQ(said(console, "fault ptu-garbled 60 0.25", 101.0), "done");
  EXPECT_TRUE(console.faults(104.9).line_cut);
  EXPECT_FALSE(console.faults(105.1).line_cut);
  EXPECT_DOUBLE_EQ(console.faults(150.0).garble_share, 0.25);
  EXPECT_EQ(said(console, "end garbled", 151.0), "done");
  EXPECT_EQ(console.faults(151.5), PtuFaults{});
  said(console, "fault line-gone", 200.0);
  EXPECT_TRUE(console.faults(1e6).line_gone);
  said(console, "end all", 1e6);
  EXPECT_EQ(console.faults(1e6 + 1.0), PtuFaults{});
}

TEST(PtuConsole, RefusesWhatItDoesNotUnderstand) {
  PtuConsole console;
  EXPECT_EQ(said(console, "", 1.0), "");
  for (const char* line : {"hello", "fault", "fault nothing 5", "fault line-cut x", "end",
                           "fault line-cut 5 1 9", "fault line-cut 0", "fault garbled 5 2",
                           "fault line-cut -1", "angles now", "angles 1 2", "end all 3"}) {
    EXPECT_EQ(said(console, line, 1.0).rfind("refused", 0), 0U) << line;
  }
  EXPECT_EQ(console.faults(1.5), PtuFaults{});
}

TEST(PtuConsole, AsksForAngles) {
  PtuConsole console;
  const auto now = std::get<PtuConsole::AskedAngles>(console.take("angles", 1.0));
  EXPECT_FALSE(now.at_s);
  const auto then = std::get<PtuConsole::AskedAngles>(console.take("angles 12.5", 13.0));
  EXPECT_DOUBLE_EQ(then.at_s.value_or(0.0), 12.5);
}

}  // namespace
}  // namespace ols::sim
