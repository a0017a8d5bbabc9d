// Finds a target without a designation: a compact object near the expected pixel. It must move
// against the background as expected, or be alone against a smooth background. The conditions are
// strict, because a wrong object is worse than none. Pure and deterministic.
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

namespace ols::tracker {

struct AcquisitionConfig {
  int frames = 3;               // consecutive frames that must show the same object
  double gate_sigma = 4.0;      // search radius around the expected pixel
  double gate_most_px = 250.0;  // maximum search radius
  // Minimum contrast, in standard deviations of the image's own fluctuations.
  double threshold_sd = 8.0;
  double least_contrast = 10.0;  // [grey levels] minimum contrast
  double least_side_px = 4.0;    // minimum length of the object's longer side
  double most_side_px = 90.0;    // maximum length of the object's longer side
  double place_px = 10.0;        // maximum drift relative to the expected pixel,
  double place_fraction = 0.15;  // plus this share of the object's size
  double size_ratio = 1.7;       // maximum change of its size
  double rival_fraction = 0.3;   // minimum relative strength of a competing object
};

// An earlier frame, with the motion of the camera and of the target since then.
struct AcquisitionReference {
  cv::Mat gray;
  Eigen::Matrix3d homography;   // from its pixels to those of the present frame
  Eigen::Vector2d expected_px;  // where the target was expected then, mapped to the present frame
};

struct AcquisitionView {
  cv::Mat gray;                 // 8-bit, one channel
  Eigen::Vector2d expected_px;  // where the target is expected
  double expected_sd_px = 0.0;
  // Set if only a line is known on which the target is: the line's direction, a unit vector. Then
  // the expected pixel is any point on the line, and expected_sd_px is the deviation across it.
  // Only a limit of the target's motion is then known: from frame to frame the target can move by
  // drift_px against the background, and its motion must be steady.
  Eigen::Vector2d line = Eigen::Vector2d::Zero();
  double drift_px = 0.0;
  std::vector<AcquisitionReference> references;  // newest first
};

struct AcquisitionCandidate {
  cv::Rect2d box;  // [px] as in cv::Rect: the origin is the top-left corner of the top-left pixel
  double strength = 0.0;  // [grey levels * px] strength of its contrast
};

class Acquisition {
 public:
  explicit Acquisition(const AcquisitionConfig& config) : config_(config) {}

  // The box of the only object on which the last frames agree; nullopt if there is none.
  std::optional<cv::Rect2d> look(const AcquisitionView& view);
  void clear() { tracks_.clear(); }
  // The candidates of the last frame. Several may be parts of one object.
  const std::vector<AcquisitionCandidate>& candidates() const { return candidates_; }

 private:
  struct Track {  // a candidate over several frames
    AcquisitionCandidate candidate;
    // The offset of its centre from the expected pixel in its first frame. On a line: its position
    // in its first frame, moved with the background to this frame.
    Eigen::Vector2d first_px;
    // Its motion against the background since the previous frame.
    Eigen::Vector2d step_px = Eigen::Vector2d::Zero();
    int seen = 1;  // number of consecutive frames
  };
  Track continued(const AcquisitionCandidate& candidate, const AcquisitionView& view) const;
  // If movers_only, stationary candidates are ignored.
  std::optional<cv::Rect2d> sole(bool movers_only) const;

  AcquisitionConfig config_;
  std::vector<AcquisitionCandidate> candidates_;
  std::vector<Track> tracks_;
};

}  // namespace ols::tracker
