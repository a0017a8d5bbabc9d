#include "base/bus/channel_pattern.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

namespace ols {
namespace {

TEST(ChannelPattern, MatchesWholeNames) {
  EXPECT_TRUE(ChannelPattern("OLS_A").matches("OLS_A"));
  EXPECT_FALSE(ChannelPattern("OLS_A").matches("OLS_AB"));
  EXPECT_TRUE(ChannelPattern("OLS_.*").matches("OLS_"));
  EXPECT_FALSE(ChannelPattern("OLS_.*").matches("XOLS_A"));
  EXPECT_TRUE(ChannelPattern(".*").matches("anything"));
  const ChannelPattern either("OLS_(A|B)|X");
  EXPECT_TRUE(either.matches("OLS_B"));
  EXPECT_TRUE(either.matches("X"));
  EXPECT_FALSE(either.matches("OLS_AX"));
  EXPECT_FALSE(either.matches("XX"));
}

TEST(ChannelPattern, TakesAViewOfPartOfAText) {
  const std::string text = "OLS_ABC";
  EXPECT_TRUE(ChannelPattern("(OLS)_A").matches(std::string_view(text).substr(0, 5)));
}

TEST(ChannelPattern, KnowsLookaheads) {
  const ChannelPattern others("(?!(?:OLS_.*)\\z).*");
  EXPECT_TRUE(others.matches("X"));
  EXPECT_FALSE(others.matches("OLS_A"));
}

TEST(ChannelPattern, SaysWhatIsWrong) {
  EXPECT_THAT([&] { ChannelPattern pattern("OLS_("); },
              testing::ThrowsMessage<std::invalid_argument>(
                  testing::HasSubstr("\"OLS_(\" is not a regular expression")));
}

}  // namespace
}  // namespace ols
