#include "calibration/pictures/gradients.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>
#include <vector>

#include "geometry/median.h"

namespace ols::calibration {

double noise_of(const cv::Mat& gray) {
  // The difference of two Laplacians; with white noise of sigma it has 6 sigma.
  const cv::Mat kernel = (cv::Mat_<float>(3, 3) << 1, -2, 1, -2, 4, -2, 1, -2, 1);
  constexpr double kOfNoise = 6.0, kSigmaOfMedian = 1.4826;
  cv::Mat response;
  cv::filter2D(gray, response, CV_32F, kernel);
  std::vector<float> sizes;
  constexpr int kEvery = 3;
  for (int y = 1; y + 1 < response.rows; y += kEvery) {
    const float* row = response.ptr<float>(y);
    for (int x = 1; x + 1 < response.cols; x += kEvery) sizes.push_back(std::abs(row[x]));
  }
  if (sizes.empty()) return 0.0;
  return kSigmaOfMedian * median(std::move(sizes)) / kOfNoise;
}

Gradients gradients_of(const cv::Mat& gray, double smoothing_px) {
  Gradients result;
  cv::Mat smooth;
  gray.convertTo(smooth, CV_32F);
  cv::GaussianBlur(smooth, smooth, {}, smoothing_px, smoothing_px, cv::BORDER_REPLICATE);
  const cv::Mat slope = (cv::Mat_<float>(1, 3) << -0.5F, 0.0F, 0.5F);
  cv::filter2D(smooth, result.x, CV_32F, slope, {-1, -1}, 0.0, cv::BORDER_REPLICATE);
  cv::filter2D(smooth, result.y, CV_32F, slope.t(), {-1, -1}, 0.0, cv::BORDER_REPLICATE);
  // White noise of sigma has after a Gaussian of s a slope of sigma / (sqrt(8 pi) s^2).
  constexpr double kRounding = 0.29;
  const double noise = std::hypot(noise_of(gray), kRounding);
  result.sd = noise / (std::sqrt(8.0 * CV_PI) * smoothing_px * smoothing_px);
  return result;
}

}  // namespace ols::calibration
