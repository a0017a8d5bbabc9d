// Finds the largest changes between adjacent frames. The paper uses frame differences in front of a
// sky without features, where no homography is found. If there is a homography, the previous frame
// is aligned first, so that the background does not change.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "edge/tracker/ego_motion.h"

namespace ols::tracker {

// Returns up to `most` maxima of the frame difference inside `area`, strongest first. The
// difference is smoothed over the target's size, `size_px`, and the maxima are at least this size
// apart. `homography` maps the previous frame's pixels to those of this frame. All positions are in
// full-frame pixels.
std::vector<Eigen::Vector2d> difference_candidates(const ReducedFrame& previous,
                                                   const ReducedFrame& current,
                                                   const std::optional<Eigen::Matrix3d>& homography,
                                                   const cv::Rect2d& area,
                                                   const Eigen::Vector2d& size_px, int most);

}  // namespace ols::tracker
