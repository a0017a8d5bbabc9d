// Brightness of a picture's strips, and its steps from row to row. Pure.
#pragma once

#include <opencv2/core.hpp>

namespace ols::skyline {

inline constexpr int kStrip_px = 2;  // width of a strip

inline int strips_of(int columns_px) { return columns_px / kStrip_px; }
// The middle of a strip [px].
inline double strip_x_px(int strip) { return kStrip_px * strip + 0.5 * (kStrip_px - 1); }

// For each row of each strip, the step of brightness between the kHalf rows above it and those from
// it downwards. Positive: brighter above.
class StripSteps {
 public:
  static constexpr int kHalf = 4;  // [px]

  // `gray`: 8 bit, one channel.
  explicit StripSteps(const cv::Mat& gray);

  int strips() const { return strips_.rows; }
  int rows() const { return strips_.cols; }
  bool has(int row) const { return row >= kHalf && row + kHalf <= rows(); }
  const float* of(int strip) const { return steps_.ptr<float>(strip); }
  const float* brightness(int strip) const { return strips_.ptr<float>(strip); }

 private:
  cv::Mat strips_, steps_;  // a strip is contiguous
};

}  // namespace ols::skyline
