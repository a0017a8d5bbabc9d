#include "edge/tracker/scene_motion.h"

#include <utility>

#include "edge/tracker/motion_model.h"

namespace ols::tracker {

SceneMotion::SceneMotion(const TrackerConfig& config, HomographyFit fit, const TrackerInput& frame,
                         const cv::Rect2d& target_box)
    : width_px_(config.ego_motion_width_px),
      estimator_(config, fit),
      present_(reduce_frame(frame.gray, width_px_)),
      references_(config.reference_interval_s),
      frame_size_(frame.gray.size()),
      time_s_(frame.time_s) {
  estimator_.start(present_);
  remember(frame.gray, target_box);
}

EgoMotion SceneMotion::advance(const TrackerInput& frame, const cv::Rect2d& target_box,
                               StageTimer& timer) {
  interval_s_ = usable_interval_s(time_s_, frame.time_s);
  time_s_ = frame.time_s;
  previous_ = std::exchange(present_, reduce_frame(frame.gray, width_px_));
  timer.lap(Stage::kReduction);
  const auto estimate = estimator_.step(present_, target_box, frame.predicted_homography);
  image_motion_ = estimate.motion;
  const bool was_known = homography_.has_value();
  homography_ = image_motion_ ? image_motion_->homography : frame.predicted_homography;
  may_be_cut_ = was_known && !homography_;
  if (homography_) {
    references_.advance(*homography_);
  } else if (!estimate.featureless) {
    references_.clear();  // a sky without features looks the same in every direction
    unaligned_since_s_ = time_s_;
  }
  timer.lap(Stage::kEgoMotion);
  if (!homography_) return EgoMotion::kNone;
  return image_motion_ ? EgoMotion::kImage : EgoMotion::kPredicted;
}

const ReferenceFrames::Reference* SceneMotion::a_moment_ago() const {
  constexpr double kEarlier = 0.2;  // [s] enough for a small mover to leave its place
  return references_.older_than(time_s_ - kEarlier);
}

}  // namespace ols::tracker
