// Reads an image between its pixels. Pure.
#pragma once

#include <limits>
#include <opencv2/core.hpp>

namespace ols::scenery {

// Bilinear; NaN outside.
template <class Pixel>
float sample(const cv::Mat_<Pixel>& image, double x, double y) {
  if (!(x >= 0.0 && y >= 0.0 && x < image.cols - 1 && y < image.rows - 1)) {
    return std::numeric_limits<float>::quiet_NaN();
  }
  const int i = static_cast<int>(x), j = static_cast<int>(y);
  const auto a = static_cast<float>(x - i), b = static_cast<float>(y - j);
  const Pixel *upper = image[j] + i, *lower = image[j + 1] + i;
  const auto along = [a](const Pixel* row) {
    return (1 - a) * static_cast<float>(row[0]) + a * static_cast<float>(row[1]);
  };
  return (1 - b) * along(upper) + b * along(lower);
}

}  // namespace ols::scenery
