// The largest changes between adjacent frames: the paper's answer to a sky without features, where
// no homography is found. If there is a homography, the previous frame is aligned first. The
// differences then show a target whose motion the model did not predict.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "edge/tracker/ego_motion.h"

namespace ols::tracker {

// Up to `most` maxima of the frame difference inside `area` of the frame, smoothed over the
// target's size, strongest first, at least one target apart. `homography` maps the previous frame's
// pixels to this one's. All in full-frame pixels.
std::vector<Eigen::Vector2d> difference_candidates(const ReducedFrame& previous,
                                                   const ReducedFrame& current,
                                                   const std::optional<Eigen::Matrix3d>& homography,
                                                   const cv::Rect2d& area,
                                                   const Eigen::Vector2d& size_px, int most);

}  // namespace ols::tracker
