// A matched filter for a spot of a few pixels against a smooth background.
#pragma once

#include <array>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

namespace ols::detector {

class BoxResidual {
 public:
  static constexpr int kUnits = 64;  // units per grey level

  // For each pixel, computes the magnitude of the difference of two means: that of the 3x3 pixels
  // around it, and that of the ring between the 7x7 and the 13x13 pixels around it. The result is
  // in 1/64 of a grey level, CV_16S; each mean is rounded down. `gray`: 8-bit, one channel. Beyond
  // the image's edges, its outermost pixels are repeated.
  void measure(const cv::Mat& gray);
  const cv::Mat& image() const { return residual_; }

 private:
  static constexpr int kReach = 6;  // [px] from the centre of the outer box to its edge
  // [px] Sides of the three boxes.
  static constexpr std::array<int, 3> kSides{3, 7, 13};
  struct Row {
    std::vector<std::uint16_t> columns;       // sums over the box's rows
    std::vector<std::uint16_t> pairs, fours;  // sums over two and four neighbouring columns
  };
  void start(int width);
  void advance(int y);
  void add_up(Row& row) const;

  cv::Mat padded_, residual_;
  std::array<Row, kSides.size()> rows_;
};

}  // namespace ols::detector
