#include "sim/ptu/command_text.h"

#include <gtest/gtest.h>

namespace ols::sim {
namespace {

TEST(PtuCommandText, ANumberIsTheWholeText) {
  EXPECT_EQ(whole_number("-14622"), -14622);
  EXPECT_EQ(whole_number("+5"), 5);
  for (const char* text : {"", "+", "-", "5a", " 5", "5 ", "1.0", "99999999999", "++5"}) {
    EXPECT_FALSE(whole_number(text)) << "'" << text << "'";
  }
}

TEST(PtuCommandText, AListHasANumberBetweenAnyTwoCommas) {
  EXPECT_EQ(whole_numbers("1,-2,3"), (std::vector<int>{1, -2, 3}));
  EXPECT_EQ(whole_numbers("7"), (std::vector<int>{7}));
  for (const char* text : {"", ",", "1,", ",1", "1,,2", "1;2"}) {
    EXPECT_FALSE(whole_numbers(text)) << "'" << text << "'";
  }
}

TEST(PtuCommandText, AnAnswerBeginsWithAStar) { EXPECT_EQ(star("-49467"), "* -49467"); }

}  // namespace
}  // namespace ols::sim
