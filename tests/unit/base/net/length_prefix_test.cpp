#include "base/net/length_prefix.h"

#include <gtest/gtest.h>

namespace ols {
namespace {

TEST(LengthPrefix, MostSignificantByteFirst) {
  EXPECT_EQ(length_prefix(0x01020304), (LengthPrefix{1, 2, 3, 4}));
  EXPECT_EQ(message_length({1, 2, 3, 4}, 0x01020304), 0x01020304U);
}

TEST(LengthPrefix, EmptyOrTooLongIsNoMessage) {
  EXPECT_EQ(message_length({0, 0, 0, 0}, 100), std::nullopt);
  EXPECT_EQ(message_length({0, 0, 0, 100}, 100), 100U);
  EXPECT_EQ(message_length({0, 0, 0, 101}, 100), std::nullopt);
  EXPECT_EQ(message_length({0xff, 0xff, 0xff, 0xff}, 100), std::nullopt);
}

}  // namespace
}  // namespace ols
