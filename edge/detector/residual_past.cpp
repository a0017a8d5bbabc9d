#include "edge/detector/residual_past.h"

#include <Eigen/LU>

#include "edge/tracker/ego_motion.h"
#include "edge/tracker/particle.h"

namespace ols::detector {

void ResidualPast::add(const cv::Mat& residual, const Eigen::Matrix3d& motion) {
  const Eigen::Matrix3d back = motion.inverse();
  for (Kept& kept : kept_) kept.from_newest = kept.from_newest * back;
  std::erase_if(kept_, [](const Kept& kept) { return !tracker::aligns(kept.from_newest); });
  kept_.push_front({residual, Eigen::Matrix3d::Identity()});
  if (kept_.size() > kImages) kept_.pop_back();
}

Eigen::Vector2d ResidualPast::shift_px(std::size_t age, const Eigen::Vector2d& pixel) const {
  return tracker::transform(kept_[age].from_newest, pixel) - pixel;
}

}  // namespace ols::detector
