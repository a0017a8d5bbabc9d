// Finds objects that move against the ground, by their difference from the aligned scene.
#pragma once

#include <optional>
#include <vector>

#include "edge/detector/detection.h"
#include "edge/detector/scene_background.h"
#include "edge/tracker/ego_motion.h"

namespace ols::detector {

struct MoverConfig {
  double threshold_sd = 6.0;        // minimum difference, in units of the tile's usual difference
  double least_levels = 10.0;       // [grey levels] minimum difference
  double least_area_px = 8.0;       // minimum area in the reduced image
  double most_side_fraction = 0.6;  // maximum width and height, relative to the image's
  std::size_t most = 30;            // maximum number of detections; the largest come first
};

class MoverFinder {
 public:
  explicit MoverFinder(const MoverConfig& config) : config_(config) {}

  // `motion` maps pixels of the previous reduced frame to the present one. If it is nullopt
  // (unknown), the search begins anew. Returns nullopt if the whole image changed at once
  // (exposure, a cloud's edge, a cut).
  std::optional<std::vector<Detection>> find(const tracker::ReducedFrame& frame, double time_s,
                                             const std::optional<Eigen::Matrix3d>& motion);

 private:
  bool everything_changed(const cv::Mat& noise) const;
  cv::Mat exceedances(const cv::Mat& difference, const cv::Mat& noise) const;
  std::vector<Detection> parts(const cv::Mat& mask, const cv::Mat& fresh, const cv::Mat& difference,
                               const tracker::ReducedFrame& frame) const;

  MoverConfig config_;
  SceneBackground background_;
};

}  // namespace ols::detector
