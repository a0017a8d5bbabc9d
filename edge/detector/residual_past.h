// Stores the results of the matched filter for the last images, and the place of the scene in each
// of them.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <deque>
#include <opencv2/core.hpp>

namespace ols::detector {

class ResidualPast {
 public:
  static constexpr std::size_t kImages = 16;

  // `residual`: the result of BinnedResidual. `motion` maps the previous image's pixels to the new
  // image's. Earlier images that can no longer be aligned are removed.
  void add(const cv::Mat& residual, const Eigen::Matrix3d& motion);
  void clear() { kept_.clear(); }
  bool complete() const { return kept_.size() == kImages; }

  // `age`: in images; 0 is the newest.
  const cv::Mat& residual(std::size_t age) const { return kept_[age].residual; }
  // A point of the scene is at `pixel` in the newest image. Returns its place in the image of this
  // age, relative to `pixel`.
  Eigen::Vector2d shift_px(std::size_t age, const Eigen::Vector2d& pixel) const;

 private:
  struct Kept {
    cv::Mat residual;
    Eigen::Matrix3d from_newest;
  };
  std::deque<Kept> kept_;  // newest first
};

}  // namespace ols::detector
