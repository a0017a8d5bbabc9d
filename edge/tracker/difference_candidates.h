// Where the picture changed most between adjacent frames: the paper's answer to a sky without
// features, where no homography is found. With one, the previous frame is brought onto the present
// one first: then it is the answer to a target that moves otherwise than was known.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "edge/tracker/ego_motion.h"

namespace ols::tracker {

// Up to `most` maxima of the frame difference inside `area` of the frame, smoothed over the
// target's size, strongest first, at least one target apart. `homography` takes the previous
// frame's pixels to this one's. Full-frame pixels everywhere.
std::vector<Eigen::Vector2d> difference_candidates(const ReducedFrame& previous,
                                                   const ReducedFrame& current,
                                                   const std::optional<Eigen::Matrix3d>& homography,
                                                   const cv::Rect2d& area,
                                                   const Eigen::Vector2d& size_px, int most);

}  // namespace ols::tracker
