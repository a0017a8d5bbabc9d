// The designated box in relation to the part of it that stands out and is tracked.
#pragma once

#include <optional>

#include "edge/tracker/motion_model.h"

namespace ols::tracker {

class Designation {
 public:
  // `core` is what stands out in `box`.
  Designation(const cv::Rect2d& box, const cv::Rect2d& core);

  // [sizes of the tracked part] Of the designated point from its centre.
  const Eigen::Vector2d& place() const { return place_; }
  Eigen::Vector2d point(const Particle& followed) const {
    return followed.pixel + place_.cwiseProduct(followed.size_px);
  }
  cv::Rect2d box(const Particle& followed) const {
    return box_of(point(followed), scale_.cwiseProduct(followed.size_px));
  }

  // While nothing stands out in the designated box (a bird with its wings edgewise, a drone behind
  // a twig): returns what stands out there soon after, otherwise empty.
  std::optional<cv::Rect2d> find_late(const cv::Mat& gray, const MotionModel& motion);

 private:
  // In sizes of the tracked part.
  Eigen::Vector2d place_;
  Eigen::Vector2d scale_;
  cv::Rect2d box_;  // while it is empty, in the present frame's pixels
  double empty_s_ = 0.0;
};

}  // namespace ols::tracker
