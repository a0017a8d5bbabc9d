#include "edge/tracker/local_contrast.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace ols::tracker {

LocalContrast::LocalContrast(const FrameView& view, const cv::Rect& area) : view_(view) {
  const int left = static_cast<int>(std::floor(view.x_of(area.x)));
  const int top = static_cast<int>(std::floor(view.y_of(area.y)));
  const cv::Rect wanted(left, top, area.width / view.reduction + 1,
                        area.height / view.reduction + 1);
  const cv::Rect inside = wanted & cv::Rect(0, 0, view.image.cols, view.image.rows);
  if (inside.empty()) return;
  corner_ = inside.tl();
  cv::integral(view.image(inside), sums_, CV_32S);
}

double LocalContrast::sum(const cv::Rect& area) const {
  const int* top = sums_.ptr<int>(area.y);
  const int* bottom = sums_.ptr<int>(area.y + area.height);
  const int right = area.x + area.width;
  return bottom[right] - bottom[area.x] - top[right] + top[area.x];
}

double LocalContrast::operator()(const Eigen::Vector2d& pixel,
                                 const Eigen::Vector2d& size_px) const {
  if (sums_.empty()) return 0.0;
  const double x = view_.x_of(pixel.x()) - corner_.x;
  const double y = view_.y_of(pixel.y()) - corner_.y;
  const auto part = [&](double share) {
    const int width = std::max(1, static_cast<int>(share * size_px.x() / view_.reduction + 0.5));
    const int height = std::max(1, static_cast<int>(share * size_px.y() / view_.reduction + 0.5));
    const cv::Rect rect(static_cast<int>(std::floor(x + 0.5 - 0.5 * (width - 1))),
                        static_cast<int>(std::floor(y + 0.5 - 0.5 * (height - 1))), width, height);
    return rect & cv::Rect(0, 0, sums_.cols - 1, sums_.rows - 1);
  };
  const cv::Rect middle = part(0.5), box = part(1.1), around = part(1.8);
  const int frame = around.area() - box.area();
  if (middle.empty() || frame <= 0) return 0.0;
  return sum(middle) / middle.area() - (sum(around) - sum(box)) / frame;
}

}  // namespace ols::tracker
