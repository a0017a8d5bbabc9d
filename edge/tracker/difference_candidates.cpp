#include "edge/tracker/difference_candidates.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "edge/tracker/particle.h"

namespace ols {

std::vector<Eigen::Vector2d> difference_candidates(const ReducedFrame& previous,
                                                   const ReducedFrame& current,
                                                   const Eigen::Vector2d& size_px, int most) {
  constexpr double kLeastResponse = 2.0;  // [grey levels] below it is noise
  cv::Mat response;
  cv::absdiff(previous.image, current.image, response);
  const int side =
      std::max(3, static_cast<int>(std::sqrt(size_px.x() * size_px.y()) / current.reduction) | 1);
  cv::blur(response, response, cv::Size(side, side), cv::Point(-1, -1), cv::BORDER_CONSTANT);
  const Eigen::Matrix3d to_full = current.to_full();
  std::vector<Eigen::Vector2d> maxima;
  while (static_cast<int>(maxima.size()) < most) {
    double value = 0.0;
    cv::Point at;
    cv::minMaxLoc(response, nullptr, &value, nullptr, &at);
    if (value < kLeastResponse) break;
    maxima.push_back(transform(to_full, {at.x, at.y}));
    const cv::Rect taken(at.x - side, at.y - side, 2 * side + 1, 2 * side + 1);
    response(taken & cv::Rect(0, 0, response.cols, response.rows)) = 0;
  }
  return maxima;
}

}  // namespace ols
