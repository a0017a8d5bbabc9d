// The interface of a tracker, which measures the pixel of one target, frame by frame. The visual
// tracker implements it, and so does the substitute in the Monte Carlo simulation, which draws the
// pixel at random instead of rendering images.
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
  // Maps pixels of the previous frame to this one, for a static scene at infinity. It is computed
  // from the PTU's angles; nullopt if unknown. An impossible homography (mirror image, zoom, most
  // of the image gone) is not used: see `prediction_dropped` of the output.
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
  // [px] Difference, at the target, between two values of the scene's motion: that of the predicted
  // homography, and that which the images show. At most the image diagonal. nullopt unless both
  // exist. A large value means that angles or times are wrong. The predicted homography is compared
  // even if it was not used.
  std::optional<double> prediction_error_px;
  bool prediction_dropped = false;  // the predicted homography was impossible, and not used
};

enum class TrackerError {
  kNotInitialised,
  kEmptyFrame,
  kFrameFormat,  // not 8-bit single-channel, or the colour picture has another size or type
  kFrameSize,    // differs from that of the first frame
  kTime,         // not later than the previous frame, or not finite
  kHomography,   // the predicted homography is not finite
  // The box's centre is outside the image, a side is below 3 px or longer than the image's, or a
  // value is not finite.
  kBox,
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
  // Tells the tracker that its lost target may be near this pixel of the next frame, because the
  // station has slewed to it. A pixel that is not finite is ignored. Others are limited to one
  // frame size outside the frame. `sd_px`: 1-sigma of the pixel.
  virtual void search_near(const Eigen::Vector2d& pixel, double sd_px) = 0;
  // Sets the target aside, and forgets one that was set aside earlier; initialise() then starts
  // another.
  virtual void set_aside() = 0;
  // Continues with the target that was set aside; does nothing if there is none.
  virtual void take_back() = 0;
};

}  // namespace ols::tracker
