#include "edge/detector/velocity_stack.h"

#include <algorithm>
#include <cstdlib>

namespace ols::detector {
namespace {

using Stack = VelocityStack;
constexpr int kPlane = Stack::kStride * Stack::kRows;
constexpr int kPairReach = Stack::kFastest;      // [bins] between the two images of a pair
constexpr int kFourReach = 2 * Stack::kFastest;  // [bins] between two pairs

constexpr std::ptrdiff_t plane(int number, int reach, const cv::Point& shift) {
  const int side = 2 * reach + 1;
  return std::ptrdiff_t{kPlane} * ((number * side + shift.y + reach) * side + shift.x + reach);
}

constexpr std::ptrdiff_t offset(const cv::Point& shift) {
  return std::ptrdiff_t{shift.y} * Stack::kStride + shift.x;
}

// Half of a shift, rounded away from zero in one stage and towards zero in the next: rounding
// errors that add up would smear what is summed.
int outer_half(int shift) { return (shift + (shift > 0 ? 1 : shift < 0 ? -1 : 0)) / 2; }
cv::Point outer_half(const cv::Point& shift) { return {outer_half(shift.x), outer_half(shift.y)}; }
cv::Point inner_half(const cv::Point& shift) { return {shift.x / 2, shift.y / 2}; }

std::uint8_t mean_of(std::uint8_t a, std::uint8_t b) {
  return static_cast<std::uint8_t>((a + b + 1) / 2);
}

// Over the tile and `margin` around it.
void average(const std::uint8_t* newer, const std::uint8_t* older, const cv::Point& shift,
             int margin, std::uint8_t* out) {
  const int from = Stack::kMargin - margin;
  const int width = Stack::kWidth + 2 * margin;
  for (int y = from; y < Stack::kMargin + Stack::kHeight + margin; ++y) {
    const std::ptrdiff_t row = std::ptrdiff_t{y} * Stack::kStride + from;
    const auto* a = newer + row;
    const auto* b = older + row - offset(shift);
    auto* mean = out + row;
    for (int x = 0; x < width; ++x) mean[x] = mean_of(a[x], b[x]);
  }
}

template <typename Use>
void for_each_shift(int reach, const Use& use) {
  for (int y = -reach; y <= reach; ++y) {
    for (int x = -reach; x <= reach; ++x) use(cv::Point(x, y));
  }
}

}  // namespace

VelocityStack::VelocityStack()
    : pairs_(static_cast<std::size_t>(plane(4, kPairReach, {-kPairReach, -kPairReach}))),
      fours_(static_cast<std::size_t>(plane(2, kFourReach, {-kFourReach, -kFourReach}))) {}

const std::uint8_t* VelocityStack::pair(int number, const cv::Point& shift) const {
  return pairs_.data() + plane(number, kPairReach, shift);
}

const std::uint8_t* VelocityStack::four(int number, const cv::Point& shift) const {
  return fours_.data() + plane(number, kFourReach, shift);
}

// Older pairs are needed further around the tile, by what an object moves until then.
void VelocityStack::sum_pairs() {
  for (int number = 0; number < kImages / 2; ++number) {
    const auto* newer = images_.at(static_cast<std::size_t>(2 * number)).data();
    const auto* older = images_.at(static_cast<std::size_t>(2 * number + 1)).data();
    for_each_shift(kPairReach, [&](const cv::Point& shift) {
      average(newer, older, shift, number * kFourReach,
              pairs_.data() + plane(number, kPairReach, shift));
    });
  }
}

void VelocityStack::sum_fours() {
  for (int number = 0; number < kImages / 4; ++number) {
    for_each_shift(kFourReach, [&](const cv::Point& shift) {
      const cv::Point half = inner_half(shift);
      average(pair(2 * number, half), pair(2 * number + 1, half), shift, number * kSteps,
              fours_.data() + plane(number, kFourReach, shift));
    });
  }
}

void VelocityStack::sum_eights() {
  highest_.fill(0);
  lowest_.fill(255);
  const std::ptrdiff_t corner = offset({kMargin, kMargin});
  for_each_shift(kSteps, [&](const cv::Point& shift) {
    const auto* newer = four(0, outer_half(shift)) + corner;
    const auto* older = four(1, outer_half(shift)) + corner - offset(shift);
    auto* high = highest_.data();
    auto* low = lowest_.data();
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        const std::uint8_t mean = mean_of(newer[x], older[x]);
        high[x] = std::max(high[x], mean);
        low[x] = std::min(low[x], mean);
      }
      newer += kStride;
      older += kStride;
      high += kWidth;
      low += kWidth;
    }
  });
}

void VelocityStack::run() {
  sum_pairs();
  sum_fours();
  sum_eights();
}

int VelocityStack::mean(const cv::Point& at, const cv::Point& steps) const {
  const std::ptrdiff_t place = offset(at + cv::Point(kMargin, kMargin));
  const cv::Point half = outer_half(steps);
  return mean_of(four(0, half)[place], four(1, half)[place - offset(steps)]);
}

}  // namespace ols::detector
