#include "edge/camera/frame_numbers.h"

#include <gtest/gtest.h>

namespace ols::camera {
namespace {

TEST(FrameNumbers, CountsOnAcrossTheWrapThatSkipsZero) {
  FrameNumbers numbers;
  const std::uint64_t first = numbers.next(65534).number;
  EXPECT_EQ(numbers.next(65535).number, first + 1);
  const auto wrapped = numbers.next(1);
  EXPECT_EQ(wrapped.number, first + 2);
  EXPECT_EQ(wrapped.lost, 0U);
  EXPECT_EQ(numbers.next(2).number, first + 3);
}

TEST(FrameNumbers, CountsWhatIsMissing) {
  FrameNumbers numbers;
  EXPECT_EQ(numbers.next(10).lost, 0U);
  EXPECT_EQ(numbers.next(13).lost, 2U);
  EXPECT_EQ(numbers.next(14).lost, 0U);
}

TEST(FrameNumbers, CountsWhatIsMissingAcrossTheWrap) {
  FrameNumbers numbers;
  const std::uint64_t first = numbers.next(65533).number;
  const auto step = numbers.next(3);  // 65534, 65535, 1, 2 are missing
  EXPECT_EQ(step.lost, 4U);
  EXPECT_EQ(step.number, first + 5);
}

TEST(FrameNumbers, ACameraThatBeginsAgainLosesNothingAndNumbersGoOn) {
  FrameNumbers numbers;
  const std::uint64_t before = numbers.next(500).number;
  const auto again = numbers.next(1);
  EXPECT_EQ(again.lost, 0U);
  EXPECT_EQ(again.number, before + 1);
  numbers.restart();
  const auto reopened = numbers.next(30000);
  EXPECT_EQ(reopened.lost, 0U);
  EXPECT_EQ(reopened.number, before + 2);
}

TEST(FrameNumbers, TakesIdsOf64Bits) {
  FrameNumbers numbers;
  const std::uint64_t first = numbers.next(65535).number;
  EXPECT_EQ(numbers.next(65536).number, first + 1);
  const auto step = numbers.next(70000);
  EXPECT_EQ(step.lost, 70000U - 65536U - 1U);
  EXPECT_EQ(step.number, first + 1 + (70000U - 65536U));
}

TEST(FrameNumbers, TheSameIdTwiceIsNotALoss) {
  FrameNumbers numbers;
  const std::uint64_t first = numbers.next(7).number;
  const auto again = numbers.next(7);
  EXPECT_EQ(again.lost, 0U);
  EXPECT_GT(again.number, first);
}

}  // namespace
}  // namespace ols::camera
