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
  // How strong its difference is, in standard deviations of the image's own differences.
  double strength = 0.0;
};

struct MoverSearch {
  cv::Rect2d area;              // [px] area of the full frame to be searched
  double threshold_sd = 5.0;    // in standard deviations of the difference
  double least_levels = 4.0;    // [grey levels] minimum difference
  double most_side_px = 150.0;  // larger objects are not distant targets
  int most = 8;                 // maximum number, strongest first
};

// Finds movers by their difference from an earlier image of the same scene. The covariance holds
// for an object that has moved by three pixels or more; with less motion, perhaps only slivers of
// the object differ. `to_present` maps the earlier image's pixels (full frame) to those of
// `current`. Edges that are misaligned by a pixel are ignored. The mover's earlier position looks
// like its present one; use two earlier images, or the mover's appearance, to distinguish them.
// Empty images, different sizes, and homographies that are not finite give no movers.
std::vector<MoverCandidate> detect_movers(const cv::Mat& earlier, const Eigen::Matrix3d& to_present,
                                          const ReducedFrame& current, const MoverSearch& search);

}  // namespace ols::tracker
