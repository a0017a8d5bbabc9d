// Small things that move against the scene, anywhere in the picture: what a lost target is looked
// for among, and what a target that nobody has marked could be found among. Pure and deterministic.
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

#include "edge/tracker/ego_motion.h"

namespace ols::tracker {

struct MoverCandidate {
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();  // its centroid, full-frame pixels
  Eigen::Matrix2d covariance_px2 = Eigen::Matrix2d::Identity();
  cv::Rect2d box;         // [px] full frame
  double strength = 0.0;  // of its difference, in standard deviations of the picture's own
};

struct MoverSearch {
  cv::Rect2d area;              // [px] of the full frame, looked at
  double threshold_sd = 5.0;    // of the difference's fluctuations
  double least_levels = 4.0;    // [grey levels] of difference, at least
  double most_side_px = 150.0;  // larger things are no distant targets
  int most = 8;                 // so many, strongest first
};

// What differs from an earlier image of the same scene. The covariance holds the place of what has
// moved by three pixels or more; of what moves less, slivers may be all that is seen. `to_present`
// takes the earlier image's pixels (full frame) to those of `current`. Edges that are off by a
// pixel do not count. Where the mover was earlier is not told from where it is: ask with two
// earlier images, or let its look decide. Empty images, other sizes and homographies that are not
// finite give none.
std::vector<MoverCandidate> detect_movers(const cv::Mat& earlier, const Eigen::Matrix3d& to_present,
                                          const ReducedFrame& current, const MoverSearch& search);

}  // namespace ols::tracker
