// The places where a lost target is searched for by its appearance, a few in each frame: around its
// last place, from the inside outwards, repeatedly.
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

namespace ols::tracker {

class WideSearch {
 public:
  static constexpr int kPlaces = 2;  // per frame
  static constexpr int kRings = 4;   // number of rings of windows around the middle one

  // The next places inside the frame, `step_px` apart, around `middle`.
  std::vector<Eigen::Vector2d> next(const Eigen::Vector2d& middle, double step_px,
                                    const cv::Size& frame);

 private:
  int looked_ = 0;  // number of windows searched in this round
};

}  // namespace ols::tracker
