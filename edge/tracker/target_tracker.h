// What measures the pixel of one target frame by frame: the visual tracker, or whatever stands in
// its place (the Monte Carlo simulation draws the pixel instead of rendering a picture).
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>

namespace ols::tracker {

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

class TargetTracker {
 public:
  virtual ~TargetTracker() = default;
  // Begins with the target in `box` of this frame. On an error the previous target is kept.
  virtual std::optional<TrackerError> initialise(const TrackerInput& frame,
                                                 const cv::Rect2d& box) = 0;
  virtual TrackerResult track(const TrackerInput& frame) = 0;
  // The target may be near this pixel of the frame given next: a station is slewed onto a target
  // that it has lost. Not finite: ignored; more than the frame's size off the frame: brought that
  // near.
  virtual void search_near(const Eigen::Vector2d& pixel, double sd_px) = 0;
  // Puts the target aside, in place of one that was; initialise() begins another one then.
  virtual void set_aside() = 0;
  // Goes on with the one that was put aside; once.
  virtual void take_back() = 0;
};

}  // namespace ols::tracker
