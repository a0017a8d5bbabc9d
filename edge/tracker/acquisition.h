// Finds a target that nobody has marked: a compact object near the pixel where it is expected,
// which moves against the background as expected or stands alone before a smooth one. Strict: a
// wrong object is worse than none. Pure and deterministic.
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

namespace ols::tracker {

struct AcquisitionConfig {
  int frames = 3;                // in a row that must show the same object
  double gate_sigma = 4.0;       // it is looked for so far from the expected pixel
  double gate_most_px = 250.0;   // and no further than this
  double threshold_sd = 8.0;     // of the picture's own fluctuations that it stands out by
  double least_contrast = 10.0;  // [grey levels] and by this at least
  double least_side_px = 4.0;    // of the object, the longer side
  double most_side_px = 90.0;    // likewise
  double place_px = 10.0;        // it keeps its place to the expected pixel so well,
  double place_fraction = 0.15;  // and this share of its size
  double size_ratio = 1.7;       // its size changes by less than this
  double rival_fraction = 0.3;   // as conspicuous as this compared with it is a rival
};

// An earlier frame and where the camera and the target were then.
struct AcquisitionReference {
  cv::Mat gray;
  Eigen::Matrix3d homography;   // from its pixels to those of the frame looked at
  Eigen::Vector2d expected_px;  // of the target, brought to the frame looked at
};

struct AcquisitionView {
  cv::Mat gray;                 // 8-bit, one channel
  Eigen::Vector2d expected_px;  // of the target
  double expected_sd_px = 0.0;
  std::vector<AcquisitionReference> references;  // newest first
};

struct AcquisitionCandidate {
  cv::Rect2d box;         // [px] as of cv::Rect: the top-left pixel's corner is its origin
  double strength = 0.0;  // [grey levels * px] how conspicuous it is
};

class Acquisition {
 public:
  explicit Acquisition(const AcquisitionConfig& config) : config_(config) {}

  // The box of the one object that the last frames agree on, or nothing.
  std::optional<cv::Rect2d> look(const AcquisitionView& view);
  void clear() { tracks_.clear(); }
  // What the last frame looked at showed; more than one of them may be the same object's parts.
  const std::vector<AcquisitionCandidate>& candidates() const { return candidates_; }

 private:
  struct Track {  // a candidate followed over frames
    AcquisitionCandidate candidate;
    Eigen::Vector2d first_offset_px;  // of its centre from the expected pixel, when first seen
    int seen = 1;                     // frames in a row
  };
  Track continued(const AcquisitionCandidate& candidate, const Eigen::Vector2d& expected_px) const;
  std::optional<cv::Rect2d> sole() const;

  AcquisitionConfig config_;
  std::vector<AcquisitionCandidate> candidates_;
  std::vector<Track> tracks_;
};

}  // namespace ols::tracker
