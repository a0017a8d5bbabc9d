// The camera's motion relative to the scene from frame to frame, and earlier images that are
// aligned by it.
#pragma once

#include <limits>
#include <optional>

#include "edge/tracker/ego_motion.h"
#include "edge/tracker/foreground_mask.h"
#include "edge/tracker/stage_times.h"
#include "edge/tracker/target_tracker.h"

namespace ols::tracker {

class SceneMotion {
 public:
  SceneMotion(const TrackerConfig& config, HomographyFit fit, const TrackerInput& frame,
              const cv::Rect2d& target_box);

  // Adds the next frame. `target_box`: where the target was in the previous frame. The predicted
  // ego-motion is used if the image does not show any.
  EgoMotion advance(const TrackerInput& frame, const cv::Rect2d& target_box, StageTimer& timer);
  // Keeps the newest frame, in which the target is in `target_box`, for later alignment.
  void remember(const cv::Mat& gray, const cv::Rect2d& target_box) {
    references_.offer(gray, time_s_, target_box);
  }

  double time_s() const { return time_s_; }
  double interval_s() const { return interval_s_; }
  const cv::Size& frame_size() const { return frame_size_; }
  const ReducedFrame& previous() const { return previous_; }
  const ReducedFrame& present() const { return present_; }
  // Maps the previous frame's pixels to the newest one's; nullopt if unknown.
  const std::optional<Eigen::Matrix3d>& homography() const { return homography_; }
  // The same, measured from the image alone; nullopt without texture.
  const std::optional<ImageMotion>& image_motion() const { return image_motion_; }
  const ReferenceFrames& references() const { return references_; }

  // When the alignment with earlier frames was last lost; a new scene begins there.
  double unaligned_since_s() const { return unaligned_since_s_; }
  bool alignment_lost() const { return unaligned_since_s_ == time_s_; }  // in the newest frame
  // True if the ego-motion was known up to the previous frame and is unknown now; the cause may be
  // a cut.
  bool may_be_cut() const { return may_be_cut_; }
  // True if there is no aligned image from a moment ago.
  bool unknown_a_moment_ago() const { return a_moment_ago() == nullptr; }
  const ReferenceFrames::Reference* a_moment_ago() const;

 private:
  int width_px_;  // maximum width of the reduced frames
  EgoMotionEstimator estimator_;
  ReducedFrame previous_;
  ReducedFrame present_;
  ReferenceFrames references_;
  std::optional<Eigen::Matrix3d> homography_;
  std::optional<ImageMotion> image_motion_;
  double unaligned_since_s_ = -std::numeric_limits<double>::infinity();
  bool may_be_cut_ = false;
  cv::Size frame_size_;
  double time_s_;
  double interval_s_ = 0.0;
};

}  // namespace ols::tracker
