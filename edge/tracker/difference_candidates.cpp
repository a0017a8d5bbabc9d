#include "edge/tracker/difference_candidates.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "edge/tracker/alignment.h"
#include "edge/tracker/particle.h"

namespace ols::tracker {
namespace {

// Binning so that a target spans about `kSpan` pixels, which is enough to find it.
int coarseness(double side, const cv::Size& image) {
  constexpr double kSpan = 8.0;
  const int wanted = static_cast<int>(side / kSpan);
  return std::max(1, std::min({wanted, image.width, image.height}));
}

// The largest maxima, each removed together with `side` around it.
std::vector<cv::Point> greatest_maxima(cv::Mat& response, int side, int most) {
  constexpr double kLeastResponse = 2.0;  // [grey levels] below it: noise
  std::vector<cv::Point> maxima;
  while (static_cast<int>(maxima.size()) < most) {
    double value = 0.0;
    cv::Point at;
    cv::minMaxLoc(response, nullptr, &value, nullptr, &at);
    if (value < kLeastResponse) break;
    maxima.push_back(at);
    const cv::Rect taken(at.x - side, at.y - side, 2 * side + 1, 2 * side + 1);
    response(taken & cv::Rect(0, 0, response.cols, response.rows)) = 0;
  }
  return maxima;
}

}  // namespace

std::vector<Eigen::Vector2d> difference_candidates(const ReducedFrame& previous,
                                                   const ReducedFrame& current,
                                                   const std::optional<Eigen::Matrix3d>& homography,
                                                   const cv::Rect2d& area,
                                                   const Eigen::Vector2d& size_px, int most) {
  const cv::Rect inside = reduced_area(current, area);
  if (inside.empty()) return {};
  const cv::Mat now = current.image(inside);
  cv::Mat before = previous.image(inside);
  if (homography) {
    const Eigen::Matrix3d to_full = current.to_full();
    const Eigen::Matrix3d to_present = to_full.inverse() * *homography * to_full;
    before = brought_to_present(previous.image, to_present, now, inside.tl());
  }
  cv::Mat difference, response;
  cv::absdiff(before, now, difference);
  const double length = std::sqrt(size_px.x() * size_px.y()) / current.reduction;
  const int coarse = coarseness(length, difference.size());
  const cv::Size size(difference.cols / coarse, difference.rows / coarse);
  cv::resize(difference(cv::Rect(0, 0, size.width * coarse, size.height * coarse)), response, size,
             0, 0, cv::INTER_AREA);
  const int side = std::max(3, static_cast<int>(length / coarse) | 1);
  // Gaussian: a box filter would respond equally wherever it contains the whole target.
  cv::GaussianBlur(response, response, cv::Size(side, side), 0.0, 0.0, cv::BORDER_CONSTANT);
  std::vector<Eigen::Vector2d> pixels;
  for (const cv::Point& at : greatest_maxima(response, side, most)) {
    const Eigen::Vector2d middle = coarse * Eigen::Vector2d(at.x + 0.5, at.y + 0.5);
    pixels.push_back(
        transform(current.to_full(), middle + Eigen::Vector2d(inside.x - 0.5, inside.y - 0.5)));
  }
  return pixels;
}

}  // namespace ols::tracker
