// Measures the contrast of a place with its surroundings. A target keeps this contrast even if it
// changes its shape, like a bird with each wing beat.
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

  // [grey levels] Mean over the middle of the box minus the mean over a band around the box; 0
  // outside the area. Arguments are in full-frame pixels.
  double operator()(const Eigen::Vector2d& pixel, const Eigen::Vector2d& size_px) const;

 private:
  double sum(const cv::Rect& area) const;

  cv::Mat sums_;  // integral image of the part of the view that is used
  cv::Point corner_;
  FrameView view_;
};

}  // namespace ols::tracker
