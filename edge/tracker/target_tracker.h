// The interface of a tracker, which measures the pixel of one target, frame by frame. It is
// implemented by the visual tracker and by a substitute (the Monte Carlo simulation draws the pixel
// instead of rendering an image).
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>

#include "edge/tracker/colour_picture.h"
#include "edge/tracker/image_motion.h"

namespace ols::tracker {

struct TrackerInput {
  cv::Mat gray;       // 8-bit, one channel, full resolution; neither modified nor kept by reference
  double time_s = 0;  // of the exposure, on any time scale; must increase from frame to frame
  // Maps pixels of the previous frame to this one (for a static scene at infinity), computed from
  // the PTU's angles. nullopt if unknown. An impossible homography (mirror image, zoom, most of the
  // image gone) is not used: see `ego_motion` of the output.
  std::optional<Eigen::Matrix3d> predicted_homography;
  // The same picture in colour, if there is one; it helps to recognise the target.
  ColourPicture colour = {};
};

enum class EgoMotion { kNone, kImage, kPredicted };  // source of this frame's homography

struct TrackerOutput {
  cv::Rect2d box;  // [px] in the full frame: top-left corner, width, height
  // [px] The point of the target that was at the centre of the designated box; (0, 0) is the centre
  // of the top-left pixel.
  Eigen::Vector2d pixel;
  Eigen::Matrix2d covariance_px2;  // white part of the covariance of `pixel`
  double belief = 0.0;             // 0..1
  EgoMotion ego_motion = EgoMotion::kNone;
  std::optional<ImageMotion> image_motion = {};  // from the previous frame; nullopt without texture
  // [px] Difference, at the target, between two predictions of the scene: the one by the predicted
  // homography, and the one by the image's own motion. At most the image diagonal. nullopt if only
  // one of the two exists. A large value means that angles or times are wrong. A prediction that
  // was not used is also compared.
  std::optional<double> prediction_error_px;
  bool prediction_dropped = false;  // there was a predicted homography, but it is impossible
};

enum class TrackerError {
  kNotInitialised,
  kEmptyFrame,
  kFrameFormat,  // not 8-bit single-channel
  kFrameSize,    // differs from that of the first frame
  kTime,         // not later than the previous frame, or not finite
  kHomography,   // the predicted homography is not finite
  kBox,          // the initial box is outside the image, empty or not finite
};
const char* to_string(TrackerError error);

// An output, or the reason why there is none. A refused frame does not change the tracker.
struct TrackerResult {
  std::optional<TrackerOutput> output;
  std::optional<TrackerError> error;
};

class TargetTracker {
 public:
  virtual ~TargetTracker() = default;
  // Starts with the target in `box` of this frame. On an error the previous target is kept.
  virtual std::optional<TrackerError> initialise(const TrackerInput& frame,
                                                 const cv::Rect2d& box) = 0;
  virtual TrackerResult track(const TrackerInput& frame) = 0;
  // Tells the tracker that the target may be near this pixel of the next frame, because a station
  // is slewed to its lost target. It is ignored if it is not finite, and limited to within a
  // frame's size of the frame.
  virtual void search_near(const Eigen::Vector2d& pixel, double sd_px) = 0;
  // Sets the target aside (replacing one set aside earlier); initialise() then starts another one.
  virtual void set_aside() = 0;
  // Continues with the target that was set aside; possible once.
  virtual void take_back() = 0;
};

}  // namespace ols::tracker
