#include "base/journal/journal_rate_limit.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace ols {
namespace {

std::vector<std::string> texts(const std::vector<JournalEvent>& lines) {
  std::vector<std::string> found;
  for (const JournalEvent& line : lines) found.push_back(line.text);
  return found;
}
using Texts = std::vector<std::string>;

News news(const char* key, const std::string& text, bool bad) {
  return {key, {.text = text, .bad = bad}};
}

TEST(JournalRateLimit, WhatIsNewIsWrittenAtOnce) {
  JournalRateLimit limit;
  const auto lines = limit.pass({news("a", "a fault", true), news("b", "b ok", false)}, 1.0);
  EXPECT_EQ(texts(lines), (Texts{"a fault", "b ok"}));
  EXPECT_TRUE(lines[0].bad);
  EXPECT_FALSE(lines[1].bad);
  EXPECT_TRUE(limit.pass({}, 2.0).empty());
}

TEST(JournalRateLimit, AFloodIsAFewLinesAndItsEndIsTold) {
  JournalRateLimit limit;
  std::size_t written = 0;
  double now_s = 0.0;
  for (int i = 0; i < 1000; ++i, now_s += 0.05) {
    written += limit.pass({news("command", "refused " + std::to_string(i), true)}, now_s).size();
  }
  EXPECT_EQ(written, 4U);
  EXPECT_EQ(texts(limit.pass({news("other", "x", true)}, now_s)), (Texts{"x"}))
      << "something else is not held back by it";
  EXPECT_EQ(texts(limit.pass({}, 61.0)), (Texts{"refused 999 (995 more like it)"}));
  EXPECT_TRUE(limit.pass({}, 200.0).empty());
}

TEST(JournalRateLimit, TheLastWordOfWhatComesAndGoesIsTold) {
  JournalRateLimit limit;
  for (int i = 0; i < 3; ++i) {
    limit.pass({news("gnss", "alarm", true)}, i);
    limit.pass({news("gnss", "over", false)}, i);
  }
  const auto late = limit.pass({}, 60.0);
  ASSERT_EQ(texts(late), (Texts{"over (1 more like it)"}));
  EXPECT_FALSE(late[0].bad);
}

}  // namespace
}  // namespace ols
