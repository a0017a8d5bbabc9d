// Where the picture changed most between adjacent frames: the paper's answer to a sky without
// features, where no homography is found.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "edge/tracker/ego_motion.h"

namespace ols {

// Up to `most` maxima of the frame difference, smoothed over the target's size, strongest first, at
// least one target apart. Full-frame pixels.
std::vector<Eigen::Vector2d> difference_candidates(const ReducedFrame& previous,
                                                   const ReducedFrame& current,
                                                   const Eigen::Vector2d& size_px, int most);

}  // namespace ols
