// Measures the contrast of a place with its surroundings. This contrast remains even if a target
// changes its shape with each wing beat.
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>

#include "edge/tracker/patch.h"

namespace ols::tracker {

class LocalContrast {
 public:
  LocalContrast() = default;
  // Uses the view's pixels within `area` of the full frame.
  LocalContrast(const FrameView& view, const cv::Rect& area);

  // [grey levels] Mean of the box's centre minus the mean of a frame around the box; 0 outside the
  // area. Arguments are in full-frame pixels.
  double operator()(const Eigen::Vector2d& pixel, const Eigen::Vector2d& size_px) const;

 private:
  double sum(const cv::Rect& area) const;

  cv::Mat sums_;  // integral image of that part of the view
  cv::Point corner_;
  FrameView view_;
};

}  // namespace ols::tracker
