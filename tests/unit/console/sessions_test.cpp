#include "console/sessions.h"

#include <gtest/gtest.h>

namespace ols::console {
namespace {

TEST(Sessions, EndWithTimeAndByLoggingOut) {
  Sessions sessions(100.0);
  sessions.begin("t", "ana", Role::kOperator, 0.0);
  EXPECT_EQ(sessions.find("t", 99.0)->name, "ana");
  EXPECT_FALSE(sessions.find("t", 100.0));
  EXPECT_FALSE(sessions.find("", 0.0));
  sessions.end("t");
  EXPECT_FALSE(sessions.find("t", 1.0));
}

TEST(Sessions, AreBounded) {
  Sessions sessions(100.0);
  for (std::size_t i = 0; i <= Sessions::kMost; ++i) {
    sessions.begin(std::to_string(i), "ana", Role::kViewer, 0.001 * static_cast<double>(i));
  }
  EXPECT_FALSE(sessions.find("0", 1.0));
  EXPECT_TRUE(sessions.find("1", 1.0));
}

TEST(Sessions, OfAPersonAreCountedAndEndedTogether) {
  Sessions sessions(100.0);
  sessions.begin("a", "ana", Role::kViewer, 0.0);
  sessions.begin("b", "ana", Role::kViewer, 50.0);
  sessions.begin("c", "bob", Role::kViewer, 0.0);
  EXPECT_EQ(sessions.counts(60.0), (std::map<std::string, int>{{"ana", 2}, {"bob", 1}}));
  EXPECT_EQ(sessions.counts(120.0), (std::map<std::string, int>{{"ana", 1}}));
  sessions.end_of("ana");
  EXPECT_EQ(sessions.counts(60.0), (std::map<std::string, int>{{"bob", 1}}));
}

TEST(Sessions, TheTokenIsFoundAmongOtherCookies) {
  EXPECT_EQ(token_in("ols_session=abc"), "abc");
  EXPECT_EQ(token_in("a=b; ols_session=abc; c=d"), "abc");
  EXPECT_EQ(token_in("xols_session=abc"), "");
  EXPECT_EQ(token_in(""), "");
}

}  // namespace
}  // namespace ols::console
