// The designated box about the part of it that stands out and is followed.
#pragma once

#include <optional>

#include "edge/tracker/motion_model.h"

namespace ols::tracker {

class Designation {
 public:
  // `core` is what stands out in `box`.
  Designation(const cv::Rect2d& box, const cv::Rect2d& core);

  // [sizes of the followed part] of the designated point from its centre.
  const Eigen::Vector2d& place() const { return place_; }
  Eigen::Vector2d point(const Particle& followed) const {
    return followed.pixel + place_.cwiseProduct(followed.size_px);
  }
  cv::Rect2d box(const Particle& followed) const {
    return box_of(point(followed), scale_.cwiseProduct(followed.size_px));
  }

  // Nothing stood out in the designated box: a bird with its wings edgewise, a drone behind a twig.
  // What stands out there soon after is what was meant; nothing as long as that is so.
  std::optional<cv::Rect2d> find_late(const cv::Mat& gray, const MotionModel& motion);

 private:
  // In sizes of the followed part.
  Eigen::Vector2d place_;
  Eigen::Vector2d scale_;
  cv::Rect2d box_;  // while there is nothing in it, the present frame's pixels
  double empty_s_ = 0.0;
};

}  // namespace ols::tracker
