// The input and the output of a station's detector.
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "edge/detector/detector.h"
#include "edge/detector/stars.h"

namespace ols::detector {

struct Picture {
  cv::Mat gray;                 // 8-bit, one channel; it is not modified
  double mid_exposure_s = 0.0;  // on any time scale
  // The motion of the scene in the image according to the mount's angles. It maps the previous
  // picture's pixels to this picture's; nullopt if unknown.
  std::optional<Eigen::Matrix3d> motion;
  Stars stars = {};
};

struct Found {
  double mid_exposure_s = 0.0;
  std::vector<Tracklet> confirmed;  // includes objects that this picture does not show
  // True if the whole image changed at once. Then, neither movers nor dim points were searched for.
  bool suspended = false;
  // The motion of the image since the previous picture that was processed, whose mid-exposure is
  // `from_s`. nullopt without texture.
  std::optional<tracker::ImageMotion> motion = {};
  double from_s = 0.0;
};

// Processes one picture after another. All must have the size of the first.
class PictureDetector {
 public:
  explicit PictureDetector(const DetectorConfig& config) : config_(config) {}
  Found look(const Picture& picture);

 private:
  DetectorConfig config_;
  std::optional<Detector> detector_;
  double looked_s_ = 0.0;  // mid-exposure of the last picture
};

}  // namespace ols::detector
