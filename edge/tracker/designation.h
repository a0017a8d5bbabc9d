// Converts between the designated box and its conspicuous part. Only this part is tracked.
#pragma once

#include <optional>

#include "edge/tracker/motion_model.h"

namespace ols::tracker {

class Designation {
 public:
  // `core`: the conspicuous part of `box`.
  Designation(const cv::Rect2d& box, const cv::Rect2d& core);

  // The designated point relative to the centre of the tracked part, in units of that part's width
  // and height.
  const Eigen::Vector2d& place() const { return place_; }
  Eigen::Vector2d point(const Particle& followed) const {
    return followed.pixel + place_.cwiseProduct(followed.size_px);
  }
  cv::Rect2d box(const Particle& followed) const {
    return box_of(point(followed), scale_.cwiseProduct(followed.size_px));
  }

  // Call it for each frame while nothing is conspicuous in the designated box (a bird with its
  // wings edgewise, a drone behind a twig). Searches the box and its surroundings, and returns the
  // part that has become conspicuous. Returns nullopt if there is none, or if two seconds have
  // passed.
  std::optional<cv::Rect2d> find_late(const cv::Mat& gray, const MotionModel& motion);

 private:
  // Both in units of the tracked part's width and height.
  Eigen::Vector2d place_;
  Eigen::Vector2d scale_;
  cv::Rect2d box_;  // in pixels of the present frame; used while nothing in it is conspicuous
  double empty_s_ = 0.0;
};

}  // namespace ols::tracker
