// How far a place stands out of its own surroundings: what stays of a target when its shape changes
// with every beat of a wing.
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>

#include "edge/tracker/patch.h"

namespace ols::tracker {

class LocalContrast {
 public:
  LocalContrast() = default;
  // Of the view's pixels within `area` of the full frame.
  LocalContrast(const FrameView& view, const cv::Rect& area);

  // [grey levels] mean of the box's middle less that of a frame around the box; 0 where that does
  // not lie within the area. Full-frame pixels.
  double operator()(const Eigen::Vector2d& pixel, const Eigen::Vector2d& size_px) const;

 private:
  double sum(const cv::Rect& area) const;

  cv::Mat sums_;  // integral image of the view's part
  cv::Point corner_;
  FrameView view_;
};

}  // namespace ols::tracker
