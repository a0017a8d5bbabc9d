// Chooses the places where a lost target is searched for by its appearance, a few for each frame.
// They form rings around its last place, from the inside outwards. After the last ring, the search
// starts again in the middle.
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

namespace ols::tracker {

class WideSearch {
 public:
  static constexpr int kPlaces = 2;  // per frame
  static constexpr int kRings = 4;   // number of rings of windows around the middle one

  // The next places around `middle`, `step_px` apart. Places outside the frame are skipped.
  std::vector<Eigen::Vector2d> next(const Eigen::Vector2d& middle, double step_px,
                                    const cv::Size& frame);

 private:
  int looked_ = 0;  // number of windows searched in this round
};

}  // namespace ols::tracker
