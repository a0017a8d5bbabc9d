#include "base/text/plain_text.h"

#include <gtest/gtest.h>

namespace ols {
namespace {

TEST(PlainText, LeavesWhatAPersonCanRead) {
  EXPECT_EQ(plain_text("gnss: 103 m from the survey"), "gnss: 103 m from the survey");
  EXPECT_EQ(plain_text("Žižkov 12° — ok"), "Žižkov 12° — ok");
  EXPECT_EQ(plain_text(""), "");
}

TEST(PlainText, MovesNoCursorAndHidesNothing) {
  EXPECT_EQ(plain_text("a\x1b[2Jb\rc\nd\te\x7f"), "a?[2Jb?c?d?e?");
  EXPECT_EQ(plain_text("\xc2\x9b"
                       "31m"),
            "?31m");  // CSI in one character
  EXPECT_EQ(plain_text("\xe2\x80\xae"
                       "evil"),
            "?evil");  // right-to-left override
  EXPECT_EQ(plain_text(std::string("a\0b", 3)), "a?b");
}

TEST(PlainText, DamagedBytesAreNoText) {
  EXPECT_EQ(plain_text("a\xff\xfe"
                       "b"),
            "a??b");
  EXPECT_EQ(plain_text("a\xc3"), "a?");  // cut off
}

}  // namespace
}  // namespace ols
