// Estimates the camera's motion relative to the scene from frame to frame, and aligns earlier
// images with the newest one.
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

  // Adds the next frame. `target_box`: where the target was in the previous frame. If the images do
  // not determine the ego-motion, the predicted one is used. Returns the source of the ego-motion.
  EgoMotion advance(const TrackerInput& frame, const cv::Rect2d& target_box, StageTimer& timer);
  // Stores the newest frame for later alignment, unless the last stored one is too recent.
  // `target_box`: where the target is in it.
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
  // The same motion, measured from the images alone; nullopt without texture.
  const std::optional<ImageMotion>& image_motion() const { return image_motion_; }
  const ReferenceFrames& references() const { return references_; }

  // Time at which the alignment with earlier frames was last lost; a new scene begins at this time.
  double unaligned_since_s() const { return unaligned_since_s_; }
  bool alignment_lost() const { return unaligned_since_s_ == time_s_; }  // in the newest frame
  // True if the ego-motion was known up to the previous frame and is unknown now; the cause may be
  // a cut.
  bool may_be_cut() const { return may_be_cut_; }
  // True if no stored image is at least 0.2 s old.
  bool unknown_a_moment_ago() const { return a_moment_ago() == nullptr; }
  // The newest stored image that is at least 0.2 s old; null if there is none.
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
