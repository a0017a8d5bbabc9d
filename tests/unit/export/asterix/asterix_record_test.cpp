#include "export/asterix/asterix_record.h"

#include <gtest/gtest.h>

namespace ols::exports {
namespace {

std::string bytes(std::initializer_list<int> values) {
  std::string text;
  for (const int value : values) text += static_cast<char>(value);
  return text;
}

TEST(AsterixRecord, ItsItemsStandInTheFieldSpecification) {
  EXPECT_EQ(AsterixRecord().with(1, "a").with(7, "b").bytes(), bytes({0x82}) + "ab");
  EXPECT_EQ(AsterixRecord().with(8, "c").with(2, "d").bytes(), bytes({0x41, 0x80}) + "dc");
  EXPECT_EQ(AsterixRecord().with(20, "e").bytes(), bytes({0x01, 0x01, 0x04}) + "e");
}

TEST(AsterixRecord, NumbersAreScaledAndStayInTheirRange) {
  EXPECT_EQ(asterix_unsigned(10.2, 0.5, 2), bytes({0x00, 0x14}));
  EXPECT_EQ(asterix_unsigned(1e9, 0.5, 1), bytes({0xff}));
  EXPECT_EQ(asterix_unsigned(-1.0, 0.5, 1), bytes({0x00}));
  EXPECT_EQ(asterix_signed(-1.0, 0.25, 2), bytes({0xff, 0xfc}));
  EXPECT_EQ(asterix_signed(-1e9, 0.25, 2), bytes({0x80, 0x00}));
  EXPECT_EQ(asterix_signed(1e9, 0.25, 2), bytes({0x7f, 0xff}));
}

TEST(AsterixRecord, TimeCountsFromMidnight) {
  EXPECT_EQ(asterix_time(86'400'000'000LL * 3), bytes({0, 0, 0}));
  EXPECT_EQ(asterix_time(86'400'000'000LL * 3 + 2'500'000), bytes({0, 0x01, 0x40}));
}

TEST(AsterixRecord, ACompoundBeginsWithWhatIsThere) {
  EXPECT_EQ(asterix_compound({{0, "x"}, {2, "y"}}), bytes({0xa0}) + "xy");
  EXPECT_EQ(asterix_block(62, {"ab", "c"}), bytes({62, 0, 6}) + "abc");
}

}  // namespace
}  // namespace ols::exports
