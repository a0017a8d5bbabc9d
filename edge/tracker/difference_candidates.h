// Finds the largest changes between adjacent frames. This is the paper's answer to a sky without
// features, for which no homography is found. If there is a homography, the previous frame is
// aligned first. The differences then show a target that does not move as predicted.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "edge/tracker/ego_motion.h"

namespace ols::tracker {

// Returns up to `most` maxima of the frame difference inside `area`, smoothed over the target's
// size, strongest first, at least one target apart. `homography` maps the previous frame's pixels
// to those of this frame. All positions are in full-frame pixels.
std::vector<Eigen::Vector2d> difference_candidates(const ReducedFrame& previous,
                                                   const ReducedFrame& current,
                                                   const std::optional<Eigen::Matrix3d>& homography,
                                                   const cv::Rect2d& area,
                                                   const Eigen::Vector2d& size_px, int most);

}  // namespace ols::tracker
