#include "edge/tracker/background_change.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "edge/tracker/particle.h"

namespace ols::tracker {
namespace {

constexpr int kBox = 16;             // samples across the box
constexpr int kSide = 3 * kBox + 2;  // with its neighbours and a border of one
constexpr double kNoise = 0.5;       // [grey levels]

// Samples, `step` pixels apart and the first one at `first`, to pixels of the frame.
Eigen::Matrix3d to_frame(const Eigen::Vector2d& first, const Eigen::Vector2d& step) {
  Eigen::Matrix3d map = Eigen::Matrix3d::Identity();
  map.diagonal().head<2>() = step;
  map.topRightCorner<2, 1>() = first;
  return map;
}

cv::Mat sampled(const cv::Mat& image, const Eigen::Matrix3d& m, int side) {
  const cv::Matx33d map(m(0, 0), m(0, 1), m(0, 2), m(1, 0), m(1, 1), m(1, 2), m(2, 0), m(2, 1),
                        m(2, 2));
  cv::Mat samples;
  cv::warpPerspective(image, samples, map, {side, side}, cv::INTER_LINEAR | cv::WARP_INVERSE_MAP,
                      cv::BORDER_REPLICATE);
  samples.convertTo(samples, CV_32F);
  cv::GaussianBlur(samples, samples, {3, 3}, 0.8);
  return samples;
}

// Distance from the range of the reference's values around each sample.
cv::Mat distance_from(const cv::Mat& gray, const ReferenceFrames::Reference& earlier,
                      const Eigen::Matrix3d& map, int side) {
  const cv::Mat samples = sampled(gray, map, side);
  const cv::Mat reference = sampled(earlier.gray, earlier.to_present.inverse() * map, side);
  const cv::Mat around = cv::getStructuringElement(cv::MORPH_RECT, {3, 3});
  cv::Mat low, high;
  cv::erode(reference, low, around);
  cv::dilate(reference, high, around);
  low -= samples;
  high = samples - high;
  cv::max(low, high, low);
  return cv::max(low, 0.0);
}

}  // namespace

double background_change(const cv::Mat& gray, const ReferenceFrames::Reference& reference,
                         const cv::Rect2d& box) {
  const Eigen::Vector2d step = size_of(box) / kBox;
  const cv::Mat distance = distance_from(
      gray, reference, to_frame(centre_of(box) - 0.5 * (kSide - 1) * step, step), kSide);
  const auto mean = [&](int column, int row) {
    return cv::mean(distance(cv::Rect(1 + column * kBox, 1 + row * kBox, kBox, kBox)))[0];
  };
  std::array<double, 8> around{};
  for (std::size_t i = 0; i < around.size(); ++i) {
    const int k = static_cast<int>(i < 4 ? i : i + 1);  // the fifth of the nine is the box itself
    around[i] = mean(k % 3, k / 3);
  }
  std::sort(around.begin(), around.end());
  return std::log((mean(1, 1) + kNoise) / (0.5 * (around[3] + around[4]) + kNoise));
}

}  // namespace ols::tracker
