// Finds a target without a designation: a compact object near the expected pixel. The object must
// move against the background as expected, or be the only object in front of a smooth background.
// The conditions are strict, because a wrong object is worse than none. Pure and deterministic.
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

namespace ols::tracker {

struct AcquisitionConfig {
  int frames = 3;               // consecutive frames that must show the same object
  double gate_sigma = 4.0;      // search radius, in units of AcquisitionView::expected_sd_px
  double gate_most_px = 250.0;  // upper limit of the search radius
  // Minimum contrast, in standard deviations of the image's own fluctuations.
  double threshold_sd = 8.0;
  double least_contrast = 10.0;  // [grey levels] minimum contrast
  double least_side_px = 4.0;    // minimum length of the object's longer side
  double most_side_px = 90.0;    // maximum length of the object's longer side
  // The object's offset from the expected pixel may differ from that in its first frame by
  // place_px, plus the share place_fraction of the object's longer side.
  double place_px = 10.0;
  double place_fraction = 0.15;  // see place_px
  double size_ratio = 1.7;       // maximum ratio of its sizes in consecutive frames
  // A second object competes with the strongest one if its strength exceeds this share of the
  // strongest object's strength.
  double rival_fraction = 0.3;
};

// An earlier frame, with the motion of the camera and of the target since then.
struct AcquisitionReference {
  cv::Mat gray;
  Eigen::Matrix3d homography;   // maps its pixels to those of the present frame
  Eigen::Vector2d expected_px;  // where the target was expected then, mapped to the present frame
};

struct AcquisitionView {
  cv::Mat gray;                 // 8-bit, one channel
  Eigen::Vector2d expected_px;  // where the target is expected
  double expected_sd_px = 0.0;  // 1-sigma in each direction
  // Zero if the target's place is known. If only a line through the image is known on which the
  // target lies, this is the line's direction, a unit vector. The expected pixel is then any point
  // on the line, and expected_sd_px is the 1-sigma across the line. The target must then move
  // steadily, by at most drift_px per frame against the background.
  Eigen::Vector2d line = Eigen::Vector2d::Zero();
  double drift_px = 0.0;
  std::vector<AcquisitionReference> references;  // newest first
};

struct AcquisitionCandidate {
  cv::Rect2d box;  // [px] as in cv::Rect: the origin is the top-left corner of the top-left pixel
  double strength = 0.0;  // [grey levels] its contrast, summed over its pixels
};

class Acquisition {
 public:
  explicit Acquisition(const AcquisitionConfig& config) : config_(config) {}

  // Takes the next frame. Returns the box of an object if the last frames all show it and no other
  // object competes with it; nullopt otherwise.
  std::optional<cv::Rect2d> look(const AcquisitionView& view);
  void clear() { tracks_.clear(); }
  // The candidates in the newest frame. Several may be parts of one object.
  const std::vector<AcquisitionCandidate>& candidates() const { return candidates_; }

 private:
  struct Track {  // a candidate over several frames
    AcquisitionCandidate candidate;
    // The offset of its centre from the expected pixel, in its first frame. If only a line is
    // known: its centre in its first frame, mapped to this frame by the background's motion.
    Eigen::Vector2d first_px;
    // If only a line is known: its motion against the background since the previous frame.
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
