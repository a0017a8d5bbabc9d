// Shift and stack: sums eight images along each of 289 velocities.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <opencv2/core.hpp>
#include <utility>
#include <vector>

namespace ols::detector {

// Works on one tile, with a margin for points that move in from outside. Means over eight images
// are computed from means over four, and these from means over two. Different velocities share
// these means, which saves time.
class VelocityStack {
 public:
  static constexpr int kImages = 8;
  static constexpr int kWidth = 64, kHeight = 32;  // [bins] size of the tile
  static constexpr int kMargin = 16;               // [bins] on each side
  static constexpr int kStride = kWidth + 2 * kMargin, kRows = kHeight + 2 * kMargin;
  static constexpr int kFastest = 2;  // [bins per image] highest speed on each axis
  // Velocities on each axis: -kSteps .. kSteps, in 1/4 bin per image.
  static constexpr int kSteps = 4 * kFastest;
  static constexpr std::uint8_t kZero = 128;  // the value that means zero

  using Values = std::array<std::uint8_t, static_cast<std::size_t>(kStride* kRows)>;
  using Tile = std::array<std::uint8_t, static_cast<std::size_t>(kWidth* kHeight)>;

  VelocityStack();
  // The values of an image, row by row, with the margins; kZero means zero. `age`: 0 is the newest.
  Values& image(std::size_t age) { return images_.at(age); }
  void run();
  // The highest and the lowest mean over all velocities, for each place in the newest image.
  const Tile& highest() const { return highest_; }
  const Tile& lowest() const { return lowest_; }
  // The mean for one place of the newest image and one velocity. `steps`: the velocity in 1/4 bin
  // per image.
  int mean(const cv::Point& at, const cv::Point& steps) const;

 private:
  const std::uint8_t* pair(int number, const cv::Point& shift) const;
  const std::uint8_t* four(int number, const cv::Point& shift) const;
  void sum_pairs();
  void sum_fours();
  void sum_eights();

  std::array<Values, kImages> images_;
  std::vector<std::uint8_t> pairs_, fours_;  // planes, like the images
  Tile highest_{}, lowest_{};
};

}  // namespace ols::detector
