#include "tools/setup/kept_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ols::setup {
namespace {

using testing::HasSubstr;

const std::string kLast = "a = 1\n[t]\nb = 2.0\n";

TEST(KeptFile, WhatIsNotThereIsWritten) { EXPECT_EQ(rewrite({}, {}, kLast).text, kLast); }

TEST(KeptFile, WhatAPersonMadeStays) {
  EXPECT_FALSE(rewrite("mine = 1\n", {}, kLast).text);
  EXPECT_FALSE(rewrite("a = 7 # mine\n[t]\nb = 2.0\n", kLast, kLast).text);
}

TEST(KeptFile, OnlyAnAnswerThatHasChangedIsChangedInPlace) {
  const std::string edited = "# my note\na = 7 # mine\n[t]\nb = 2.0  # unit\nc = 3\n";
  const Rewrite now = rewrite(edited, kLast, "a = 1\n[t]\nb = 4.5\n");
  ASSERT_TRUE(now.text);
  EXPECT_EQ(*now.text, "# my note\na = 7 # mine\n[t]\nb = 4.5  # unit\nc = 3\n");
  EXPECT_THAT(now.note, HasSubstr("t.b"));
}

TEST(KeptFile, ANewAnswerIsAdded) {
  const Rewrite now = rewrite(kLast, kLast, kLast + "d = \"x\"\n");
  ASSERT_TRUE(now.text);
  EXPECT_THAT(*now.text, HasSubstr("d = \"x\""));
}

TEST(KeptFile, AWholeFileIsReplacedOnlyAsItWasLeft) {
  EXPECT_EQ(rewrite_whole({}, {}, "X=1\n").text, "X=1\n");
  EXPECT_EQ(rewrite_whole("X=0\n", "X=0\n", "X=1\n").text, "X=1\n");
  EXPECT_FALSE(rewrite_whole("X=9\n", "X=0\n", "X=1\n").text);
  EXPECT_FALSE(rewrite_whole("X=9\n", {}, "X=1\n").text);
  EXPECT_FALSE(rewrite_whole("X=1\n", "X=0\n", "X=1\n").text);
}

}  // namespace
}  // namespace ols::setup
