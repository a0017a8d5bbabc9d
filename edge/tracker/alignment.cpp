#include "edge/tracker/alignment.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core/eigen.hpp>
#include <opencv2/imgproc.hpp>

namespace ols::tracker {

cv::Rect reduced_area(const ReducedFrame& frame, const cv::Rect2d& area) {
  // Edge by edge: corner and size rounded separately could exceed the image's edge.
  const double scale = 1.0 / frame.reduction;
  const auto inside = [scale](double at, int side, auto whole) {
    return static_cast<int>(std::clamp(whole(at * scale), 0.0, static_cast<double>(side)));
  };
  const auto down = [](double value) { return std::floor(value); };
  const auto up = [](double value) { return std::ceil(value); };
  const cv::Mat& image = frame.image;
  return {cv::Point(inside(area.x, image.cols, down), inside(area.y, image.rows, down)),
          cv::Point(inside(area.br().x, image.cols, up), inside(area.br().y, image.rows, up))};
}

cv::Mat brought_to_present(const cv::Mat& earlier, const Eigen::Matrix3d& to_present,
                           const cv::Mat& now, const cv::Point& origin) {
  Eigen::Matrix3d shift = Eigen::Matrix3d::Identity();
  shift(0, 2) = -origin.x;
  shift(1, 2) = -origin.y;
  cv::Mat matrix;
  cv::eigen2cv(Eigen::Matrix3d(shift * to_present), matrix);
  cv::Mat brought = now.clone();
  cv::warpPerspective(earlier, brought, matrix, brought.size(), cv::INTER_LINEAR,
                      cv::BORDER_TRANSPARENT);
  return brought;
}

}  // namespace ols::tracker
