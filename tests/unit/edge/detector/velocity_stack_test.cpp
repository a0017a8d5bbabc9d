#include "edge/detector/velocity_stack.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <opencv2/core.hpp>
#include <random>

namespace ols::detector {
namespace {

using Stack = VelocityStack;
constexpr int kSignal = 100;

std::uint8_t& value(Stack& stack, std::size_t age, int x, int y) {
  return stack.image(age).at(
      static_cast<std::size_t>((y + Stack::kMargin) * Stack::kStride + x + Stack::kMargin));
}

void clear(Stack& stack) {
  for (std::size_t age = 0; age < Stack::kImages; ++age) stack.image(age).fill(Stack::kZero);
}

int at(const Stack::Tile& tile, int x, int y) {
  return tile.at(static_cast<std::size_t>(y * Stack::kWidth + x));
}

// A spot as wide as that of the filter, which moves by `steps` quarters of a bin.
void draw(Stack& stack, const cv::Point& newest, const cv::Point& steps) {
  for (std::size_t age = 0; age < Stack::kImages; ++age) {
    const double x = newest.x - 0.25 * static_cast<double>(age) * steps.x;
    const double y = newest.y - 0.25 * static_cast<double>(age) * steps.y;
    for (int v = static_cast<int>(y) - 3; v <= y + 3; ++v) {
      for (int u = static_cast<int>(x) - 3; u <= x + 3; ++u) {
        if (u < -Stack::kMargin || u >= Stack::kWidth + Stack::kMargin) continue;
        if (v < -Stack::kMargin || v >= Stack::kHeight + Stack::kMargin) continue;
        const double apart2 = std::pow(u - x, 2) + std::pow(v - y, 2);
        value(stack, age, u, v) =
            static_cast<std::uint8_t>(Stack::kZero + kSignal * std::exp(-0.5 * apart2 / 0.6));
      }
    }
  }
}

TEST(VelocityStack, KeepsTheSignalAtWholeVelocities) {
  Stack stack;
  for (const cv::Point velocity : {cv::Point(0, 0), {1, 0}, {-1, 1}, {2, -2}}) {
    clear(stack);
    draw(stack, {20, 15}, 4 * velocity);
    stack.run();
    SCOPED_TRACE(velocity);
    EXPECT_GE(at(stack.highest(), 20, 15), Stack::kZero + kSignal - 1);
    EXPECT_GE(stack.mean({20, 15}, 4 * velocity), Stack::kZero + kSignal - 1);
    EXPECT_LE(at(stack.lowest(), 20, 15), Stack::kZero + kSignal / 4);
  }
}

TEST(VelocityStack, KeepsMostOfTheSignalAtEveryVelocity) {
  Stack stack;
  double sum = 0.0;
  int count = 0;
  for (int y = -Stack::kSteps; y <= Stack::kSteps; y += 2) {
    for (int x = -Stack::kSteps; x <= Stack::kSteps; x += 3) {
      clear(stack);
      draw(stack, {30, 16}, {x, y});
      stack.run();
      sum += at(stack.highest(), 30, 16) - Stack::kZero;
      ++count;
    }
  }
  EXPECT_GT(sum / count, 0.8 * kSignal);
}

TEST(VelocityStack, ReachesTheEdgesOfTheTileFromOutside) {
  Stack stack;
  clear(stack);
  draw(stack, {0, 0}, {8, 8});
  stack.run();
  EXPECT_GE(at(stack.highest(), 0, 0), Stack::kZero + kSignal - 1);
  clear(stack);
  draw(stack, {Stack::kWidth - 1, Stack::kHeight - 1}, {-8, -8});
  stack.run();
  EXPECT_GE(at(stack.highest(), Stack::kWidth - 1, Stack::kHeight - 1), Stack::kZero + kSignal - 1);
}

TEST(VelocityStack, DarkPointsAreLowest) {
  Stack stack;
  clear(stack);
  for (std::size_t age = 0; age < Stack::kImages; ++age)
    value(stack, age, 40 + static_cast<int>(age), 10) = Stack::kZero - kSignal;
  stack.run();
  EXPECT_LE(at(stack.lowest(), 40, 10), Stack::kZero - kSignal + 2);
  EXPECT_EQ(stack.mean({40, 10}, {-4, 0}), at(stack.lowest(), 40, 10));
}

TEST(VelocityStack, AveragesNoise) {
  constexpr double kSd = 28.0;
  std::mt19937 random(2);
  std::normal_distribution<double> noise(Stack::kZero, kSd);
  Stack stack;
  for (std::size_t age = 0; age < Stack::kImages; ++age) {
    for (std::uint8_t& one : stack.image(age)) one = cv::saturate_cast<std::uint8_t>(noise(random));
  }
  stack.run();
  double squares = 0.0;
  for (int y = 0; y < Stack::kHeight; ++y) {
    for (int x = 0; x < Stack::kWidth; ++x)
      squares += std::pow(stack.mean({x, y}, {5, -3}) - Stack::kZero, 2);
  }
  const double sd = std::sqrt(squares / (Stack::kWidth * Stack::kHeight));
  EXPECT_NEAR(sd, kSd / std::sqrt(8.0), 0.08 * kSd);
}

}  // namespace
}  // namespace ols::detector
