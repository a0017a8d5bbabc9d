#include "edge/tracker/designation.h"

#include "edge/tracker/core_box.h"

namespace ols::tracker {

Designation::Designation(const cv::Rect2d& box, const cv::Rect2d& core)
    : place_((centre_of(box) - centre_of(core)).cwiseQuotient(size_of(core))),
      scale_(size_of(box).cwiseQuotient(size_of(core))),
      box_(box) {}

std::optional<cv::Rect2d> Designation::find_late(const cv::Mat& gray, const MotionModel& motion) {
  constexpr double kWider = 1.8;
  constexpr double kLongest = 2.0;  // [s]
  const Particle designated =
      bounded({motion.still(centre_of(box_)), Eigen::Vector2d::Zero(), size_of(box_)}, gray.size());
  box_ = box_of(designated.pixel, designated.size_px);
  empty_s_ += motion.interval_s();
  if (empty_s_ > kLongest) return std::nullopt;
  const cv::Rect2d wide = box_of(centre_of(box_), kWider * size_of(box_));
  const cv::Rect2d core = find_core(gray, wide);
  if (core == wide) return std::nullopt;
  place_.setZero();
  scale_ = size_of(box_).cwiseQuotient(size_of(core));
  return core;
}

}  // namespace ols::tracker
