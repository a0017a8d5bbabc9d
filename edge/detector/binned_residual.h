// A matched filter for a point of one to three pixels, at half of the image's resolution.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

namespace ols::detector {

class BinnedResidual {
 public:
  static constexpr int kUnits = 64;  // units per grey level
  // [units] Standard deviation of the residual if the image is white noise of one grey level.
  static constexpr double kUnitsOfNoise = 20.0;

  // The value of each bin is the difference of two means. The first is the mean of 4x4 pixels,
  // weighted (1, 3, 3, 1) along both axes. The second is the mean of these first means over 9x9
  // bins. `gray`: 8-bit, one channel. The result is half as wide and high, in 1/64 of a grey level,
  // CV_16S. The centre of bin (x, y) is pixel (2x + 0.5, 2y + 0.5).
  cv::Mat measure(const cv::Mat& gray);

 private:
  void smooth_row(const cv::Mat& gray, int y);

  // Column sums for one row of bins, with a border of one pixel.
  std::vector<std::int16_t> columns_;
  cv::Mat smooth_, mean_;
};

}  // namespace ols::detector
