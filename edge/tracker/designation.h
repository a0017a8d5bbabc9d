// The designated box, relative to its conspicuous part, which is tracked.
#pragma once

#include <optional>

#include "edge/tracker/motion_model.h"

namespace ols::tracker {

class Designation {
 public:
  // `core`: the conspicuous part of `box`.
  Designation(const cv::Rect2d& box, const cv::Rect2d& core);

  // Position of the designated point from the tracked part's centre, in sizes of that part.
  const Eigen::Vector2d& place() const { return place_; }
  Eigen::Vector2d point(const Particle& followed) const {
    return followed.pixel + place_.cwiseProduct(followed.size_px);
  }
  cv::Rect2d box(const Particle& followed) const {
    return box_of(point(followed), scale_.cwiseProduct(followed.size_px));
  }

  // Used while nothing is conspicuous in the designated box (a bird with its wings edgewise, a
  // drone behind a twig). Returns what becomes conspicuous there soon after; nullopt: nothing yet.
  std::optional<cv::Rect2d> find_late(const cv::Mat& gray, const MotionModel& motion);

 private:
  // In sizes of the tracked part.
  Eigen::Vector2d place_;
  Eigen::Vector2d scale_;
  cv::Rect2d box_;  // while nothing is conspicuous in it, in the present frame's pixels
  double empty_s_ = 0.0;
};

}  // namespace ols::tracker
