#include "edge/journal.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace ols::station {
namespace {

std::vector<std::string> texts(const std::vector<JournalLine>& lines) {
  std::vector<std::string> found;
  for (const JournalLine& line : lines) found.push_back(line.text);
  return found;
}
using Texts = std::vector<std::string>;

TEST(Journal, WhatIsNewIsWrittenAtOnce) {
  Journal journal;
  const auto lines = journal.pass({{"a", "a fault", true}, {"b", "b ok", false}}, 1.0);
  EXPECT_EQ(texts(lines), (Texts{"a fault", "b ok"}));
  EXPECT_TRUE(lines[0].bad);
  EXPECT_FALSE(lines[1].bad);
  EXPECT_TRUE(journal.pass({}, 2.0).empty());
}

TEST(Journal, AFloodIsAFewLinesAndItsEndIsTold) {
  Journal journal;
  std::size_t written = 0;
  double now_s = 0.0;
  for (int i = 0; i < 1000; ++i, now_s += 0.05) {
    written += journal.pass({{"command", "refused " + std::to_string(i), true}}, now_s).size();
  }
  EXPECT_EQ(written, 4U);
  EXPECT_EQ(texts(journal.pass({{"other", "x", true}}, now_s)), (Texts{"x"}))
      << "something else is not held back by it";
  EXPECT_EQ(texts(journal.pass({}, 61.0)), (Texts{"refused 999 (995 more like it)"}));
  EXPECT_TRUE(journal.pass({}, 200.0).empty());
}

TEST(Journal, TheLastWordOfWhatComesAndGoesIsTold) {
  Journal journal;
  for (int i = 0; i < 3; ++i) {
    journal.pass({{"gnss", "alarm", true}}, i);
    journal.pass({{"gnss", "over", false}}, i);
  }
  const auto late = journal.pass({}, 60.0);
  ASSERT_EQ(texts(late), (Texts{"over (1 more like it)"}));
  EXPECT_FALSE(late[0].bad);
}

}  // namespace
}  // namespace ols::station
