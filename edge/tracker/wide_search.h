// The places where a lost target is looked for by its appearance, a few in each frame: around where
// it was seen, from the inside outwards, again and again.
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

namespace ols::tracker {

class WideSearch {
 public:
  static constexpr int kPlaces = 2;  // a frame
  static constexpr int kRings = 4;   // of windows around the middle one

  // The next ones inside the frame: `step_px` apart, around `middle`.
  std::vector<Eigen::Vector2d> next(const Eigen::Vector2d& middle, double step_px,
                                    const cv::Size& frame);

 private:
  int looked_ = 0;  // at so many of this round's windows
};

}  // namespace ols::tracker
