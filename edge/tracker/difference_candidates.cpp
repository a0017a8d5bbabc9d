#include "edge/tracker/difference_candidates.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "edge/tracker/particle.h"

namespace ols {
namespace {

// The previous image as the camera would see it now; what it did not see is as it is now.
cv::Mat brought_to_present(const ReducedFrame& previous, const ReducedFrame& current,
                           const Eigen::Matrix3d& homography) {
  const Eigen::Matrix3d to_full = current.to_full();
  const Eigen::Matrix3d h = to_full.inverse() * homography * to_full;
  const cv::Matx33d matrix(h(0, 0), h(0, 1), h(0, 2), h(1, 0), h(1, 1), h(1, 2), h(2, 0), h(2, 1),
                           h(2, 2));
  cv::Mat brought = current.image.clone();
  cv::warpPerspective(previous.image, brought, matrix, brought.size(), cv::INTER_LINEAR,
                      cv::BORDER_TRANSPARENT);
  return brought;
}

cv::Rect reduced_area(const ReducedFrame& frame, const cv::Rect2d& area) {
  const double scale = 1.0 / frame.reduction;
  const cv::Point2d corner(std::floor(area.x * scale), std::floor(area.y * scale));
  const cv::Rect2d reduced(corner.x, corner.y, std::ceil(area.br().x * scale) - corner.x,
                           std::ceil(area.br().y * scale) - corner.y);
  return cv::Rect(reduced & cv::Rect2d(0.0, 0.0, frame.image.cols, frame.image.rows));
}

}  // namespace

std::vector<Eigen::Vector2d> difference_candidates(const ReducedFrame& previous,
                                                   const ReducedFrame& current,
                                                   const std::optional<Eigen::Matrix3d>& homography,
                                                   const cv::Rect2d& area,
                                                   const Eigen::Vector2d& size_px, int most) {
  constexpr double kLeastResponse = 2.0;  // [grey levels] below it is noise
  const cv::Rect inside = reduced_area(current, area);
  if (inside.empty()) return {};
  const cv::Mat before =
      homography ? brought_to_present(previous, current, *homography) : previous.image;
  cv::Mat response;
  cv::absdiff(before(inside), current.image(inside), response);
  const int side =
      std::max(3, static_cast<int>(std::sqrt(size_px.x() * size_px.y()) / current.reduction) | 1);
  // A box would reach as much wherever it holds the whole target.
  cv::GaussianBlur(response, response, cv::Size(side, side), 0.0, 0.0, cv::BORDER_CONSTANT);
  const Eigen::Matrix3d to_full = current.to_full();
  std::vector<Eigen::Vector2d> maxima;
  while (static_cast<int>(maxima.size()) < most) {
    double value = 0.0;
    cv::Point at;
    cv::minMaxLoc(response, nullptr, &value, nullptr, &at);
    if (value < kLeastResponse) break;
    maxima.push_back(transform(to_full, {at.x + inside.x, at.y + inside.y}));
    const cv::Rect taken(at.x - side, at.y - side, 2 * side + 1, 2 * side + 1);
    response(taken & cv::Rect(0, 0, response.cols, response.rows)) = 0;
  }
  return maxima;
}

}  // namespace ols
