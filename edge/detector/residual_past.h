// The matched filter's results of the last images, and where the scene was in each.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <deque>
#include <opencv2/core.hpp>

namespace ols::detector {

class ResidualPast {
 public:
  static constexpr std::size_t kImages = 16;

  // `residual`: of BinnedResidual. `motion` maps the previous image's pixels to the new image's. If
  // the motion cannot be inverted, the past begins anew.
  void add(const cv::Mat& residual, const Eigen::Matrix3d& motion);
  void clear() { kept_.clear(); }
  bool complete() const { return kept_.size() == kImages; }

  // By age in images: 0 is the newest.
  const cv::Mat& residual(std::size_t age) const { return kept_[age].residual; }
  // How far the scene at a pixel of the newest image was from that pixel, in pixels.
  Eigen::Vector2d shift_px(std::size_t age, const Eigen::Vector2d& pixel) const;

 private:
  struct Kept {
    cv::Mat residual;
    Eigen::Matrix3d from_newest;
  };
  std::deque<Kept> kept_;  // newest first
};

}  // namespace ols::detector
