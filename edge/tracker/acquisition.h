// Finds a target without a designation: a compact object near the expected pixel that moves against
// the background as expected, or is alone in front of a smooth one. Strict, because a wrong object
// is worse than none. Pure and deterministic.
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

namespace ols::tracker {

struct AcquisitionConfig {
  int frames = 3;                // consecutive frames that must show the same object
  double gate_sigma = 4.0;       // search radius around the expected pixel
  double gate_most_px = 250.0;   // maximum search radius
  double threshold_sd = 8.0;     // minimum contrast, in the image's own fluctuations
  double least_contrast = 10.0;  // [grey levels] minimum contrast
  double least_side_px = 4.0;    // minimum of the object's longer side
  double most_side_px = 90.0;    // maximum of the object's longer side
  double place_px = 10.0;        // maximum drift relative to the expected pixel,
  double place_fraction = 0.15;  // plus this share of the object's size
  double size_ratio = 1.7;       // maximum change of its size
  double rival_fraction = 0.3;   // minimum relative strength of a competing object
};

// An earlier frame, with the camera's and the target's position in it.
struct AcquisitionReference {
  cv::Mat gray;
  Eigen::Matrix3d homography;   // from its pixels to those of the present frame
  Eigen::Vector2d expected_px;  // of the target, mapped to the present frame
};

struct AcquisitionView {
  cv::Mat gray;                 // 8-bit, one channel
  Eigen::Vector2d expected_px;  // of the target
  double expected_sd_px = 0.0;
  // If only a line is known on which the target is: the line's direction, a unit vector. The
  // expected pixel is any point on it, and the deviation is that across it. Of the target's motion
  // only a limit is then known: how far it can move from frame to frame against the background. The
  // target must move evenly.
  Eigen::Vector2d line = Eigen::Vector2d::Zero();
  double drift_px = 0.0;
  std::vector<AcquisitionReference> references;  // newest first
};

struct AcquisitionCandidate {
  cv::Rect2d box;  // [px] like cv::Rect: the origin is the top-left corner of the top-left pixel
  double strength = 0.0;  // [grey levels * px] how strongly it contrasts
};

class Acquisition {
 public:
  explicit Acquisition(const AcquisitionConfig& config) : config_(config) {}

  // The box of the only object on which the last frames agree, or empty.
  std::optional<cv::Rect2d> look(const AcquisitionView& view);
  void clear() { tracks_.clear(); }
  // The candidates of the last frame. Several may be parts of one object.
  const std::vector<AcquisitionCandidate>& candidates() const { return candidates_; }

 private:
  struct Track {  // a candidate over several frames
    AcquisitionCandidate candidate;
    // The offset of its centre from the expected pixel in the first frame. On a line: its position
    // then, moved with the background into this frame.
    Eigen::Vector2d first_px;
    // Motion against the background since the frame before.
    Eigen::Vector2d step_px = Eigen::Vector2d::Zero();
    int seen = 1;  // consecutive frames
  };
  Track continued(const AcquisitionCandidate& candidate, const AcquisitionView& view) const;
  // Without stationary candidates, if movers_only.
  std::optional<cv::Rect2d> sole(bool movers_only) const;

  AcquisitionConfig config_;
  std::vector<AcquisitionCandidate> candidates_;
  std::vector<Track> tracks_;
};

}  // namespace ols::tracker
