// What a station's detector is given, and what it gives back.
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "edge/detector/detector.h"

namespace ols::detector {

struct Picture {
  cv::Mat gray;                 // 8-bit, one channel; not modified
  double mid_exposure_s = 0.0;  // any epoch
  // The mount's motion, which maps the previous picture's pixels to this picture's; empty: unknown.
  std::optional<Eigen::Matrix3d> motion;
};

struct Found {
  double mid_exposure_s = 0.0;
  std::vector<Tracklet> confirmed;  // including objects that this picture does not show
  bool suspended = false;           // everything changed at once: no movers were looked for
};

// Looks at one picture after another, all of the size of the first.
class PictureDetector {
 public:
  explicit PictureDetector(const DetectorConfig& config) : config_(config) {}
  Found look(const Picture& picture);

 private:
  DetectorConfig config_;
  std::optional<Detector> detector_;
};

}  // namespace ols::detector
