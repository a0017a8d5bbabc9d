// The visual tracker (paper section 5): pixels in, one pixel measurement out.
//
// Knows nothing of PTU counts, LCM, files or clocks: an image, its time and, where the caller knows
// one, the predicted ego-motion go in. Deterministic: the same seed and images give the same
// output.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>

#include "edge/tracker/stage_times.h"
#include "edge/tracker/tracker_config.h"

namespace ols {

struct TrackerInput {
  cv::Mat gray;       // 8-bit, one channel, full resolution; not modified, not kept by reference
  double time_s = 0;  // of the exposure, any epoch, must grow from frame to frame
  // Takes pixels of the previous frame to pixels of this one (static scene at infinity), from the
  // PTU angles. Nothing when unknown. One that no camera between two frames makes (a mirror, a
  // zoom, most of the picture gone) is not used: the output's `ego_motion` tells.
  std::optional<Eigen::Matrix3d> predicted_homography;
};

enum class EgoMotion { kNone, kImage, kPredicted };  // where this frame's homography came from

struct TrackerOutput {
  cv::Rect2d box;  // [px] in the full frame: top-left corner, width, height
  // [px] the point of the target that was the centre of the designated box; (0, 0) is the centre of
  // the top-left pixel.
  Eigen::Vector2d pixel;
  Eigen::Matrix2d covariance_px2;  // of `pixel`, white part
  double belief = 0.0;             // 0..1
  EgoMotion ego_motion = EgoMotion::kNone;
  // [px] how far the predicted homography puts the scene behind the target from where the image's
  // own does, at most the picture's diagonal; nothing where there is only one of them. Large:
  // angles or times are wrong. A prediction that was not used is compared as well.
  std::optional<double> prediction_error_px;
  bool prediction_dropped = false;  // there was one, and no camera turns so between two frames
};

enum class TrackerError {
  kNotInitialised,
  kEmptyFrame,
  kFrameFormat,  // not 8-bit single-channel
  kFrameSize,    // other than that of the frame it was initialised on
  kTime,         // not later than the previous frame, or not finite
  kHomography,   // predicted one is not finite
  kBox,          // initial box outside the image, without area or not finite
};
const char* to_string(TrackerError error);

// Either an output or the reason why there is none; a refused frame leaves the tracker as it was.
struct TrackerResult {
  std::optional<TrackerOutput> output;
  std::optional<TrackerError> error;
};

class Tracker {
 public:
  Tracker(const TrackerConfig& config, std::uint64_t seed);
  ~Tracker();
  Tracker(Tracker&&) noexcept;
  Tracker& operator=(Tracker&&) noexcept;

  // Begins with the target in `box` of this frame. On an error the previous target is kept.
  std::optional<TrackerError> initialise(const TrackerInput& frame, const cv::Rect2d& box);

  // One step: ego-motion, prediction (2)-(4), weighting (5), MAP, resampling.
  TrackerResult track(const TrackerInput& frame);

  // The target may be near this pixel (of the frame given next): spreads the particles there, keeps
  // the template. Used when the station is slewed onto a target that it had lost. Not finite:
  // ignored; more than the frame's size off the frame: brought that near.
  void search_near(const Eigen::Vector2d& pixel, double sd_px);

  bool initialised() const;

  // Without a clock nothing is timed. The times are those of the newest frame tracked.
  void set_stage_clock(StageClock clock);
  const StageTimes& stage_times() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ols
