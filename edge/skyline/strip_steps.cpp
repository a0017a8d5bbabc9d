#include "edge/skyline/strip_steps.h"

#include <opencv2/imgproc.hpp>

namespace ols::skyline {

StripSteps::StripSteps(const cv::Mat& gray) {
  const cv::Mat whole = gray.colRange(0, strips_of(gray.cols) * kStrip_px);
  cv::Mat brightness;
  whole.convertTo(brightness, CV_32F);
  cv::resize(brightness, brightness, {strips_of(gray.cols), gray.rows}, 0.0, 0.0, cv::INTER_AREA);
  strips_ = brightness.t();
  steps_ = cv::Mat::zeros(strips_.size(), CV_32F);
  for (int strip = 0; strip < strips_.rows; ++strip) {
    const float* b = strips_.ptr<float>(strip);
    float* out = steps_.ptr<float>(strip);
    double above = 0.0, below = 0.0;
    for (int row = 0; row < 2 * kHalf && row < rows(); ++row)
      (row < kHalf ? above : below) += b[row];
    for (int row = kHalf; row + kHalf <= rows(); ++row) {
      out[row] = static_cast<float>((above - below) / kHalf);
      if (row + kHalf == rows()) break;
      above += b[row] - b[row - kHalf];
      below += b[row + kHalf] - b[row];
    }
  }
}

}  // namespace ols::skyline
