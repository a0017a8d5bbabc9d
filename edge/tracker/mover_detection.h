// Detects small objects that move relative to the scene, anywhere in the image. They are candidates
// for a lost target. Pure and deterministic.
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

#include "edge/tracker/ego_motion.h"

namespace ols::tracker {

struct MoverCandidate {
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();  // its centroid, in full-frame pixels
  Eigen::Matrix2d covariance_px2 = Eigen::Matrix2d::Identity();
  cv::Rect2d box;  // [px] in the full frame
  // Its greatest difference from the earlier image, in standard deviations of the difference image.
  double strength = 0.0;
};

struct MoverSearch {
  cv::Rect2d area;            // [px] area of the full frame to be searched
  double threshold_sd = 5.0;  // minimum difference, in standard deviations of the difference image
  double least_levels = 4.0;  // [grey levels] minimum difference
  // Maximum length of the longer side; a larger object is not a distant target.
  double most_side_px = 150.0;
  int most = 8;  // maximum number of results; the strongest come first
};

// Finds movers by their difference from an earlier image of the same scene. The covariance holds
// for an object that has moved by three pixels or more. After less motion, the images may differ
// only in slivers of the object. `to_present` maps the earlier image's pixels (full frame) to those
// of `current`. Edges that are misaligned by a pixel are ignored. At a mover's earlier position,
// the images differ just as at its present one. Use two earlier images, or the mover's appearance,
// to distinguish the two positions. Returns nothing if an image is empty, or if `to_present` is not
// finite or nearly singular.
std::vector<MoverCandidate> detect_movers(const cv::Mat& earlier, const Eigen::Matrix3d& to_present,
                                          const ReducedFrame& current, const MoverSearch& search);

}  // namespace ols::tracker
