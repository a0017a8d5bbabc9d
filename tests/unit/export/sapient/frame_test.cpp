#include "export/sapient/frame.h"

#include <gtest/gtest.h>

namespace ols::exports {
namespace {

TEST(Frame, TheLengthComesFirstLeastSignificantByteBefore) {
  const std::string bytes = framed(std::string(0x0102, 'x'));
  EXPECT_EQ(bytes.substr(0, 5), std::string("\x02\x01\x00\x00x", 5));
  EXPECT_EQ(framed_length(bytes), 0x0102U);
  EXPECT_EQ(framed_length(bytes.substr(0, 3)), std::nullopt);
  EXPECT_EQ(framed_length("\xff\xff\xff\xff"), 0xffff'ffffU);
}

}  // namespace
}  // namespace ols::exports
