#include "edge/station.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/angles.h"

namespace ols {
Station::Station(const StationConfig& config, std::unique_ptr<TargetTracker> tracker)
    : config_(config),
      tracker_(std::move(tracker)),
      history_(config.angles),
      motion_(config.motion),
      acquisition_(config.acquisition) {
  for (int i = 0; i <= static_cast<int>(StationState::kEmergency); ++i) {
    counters_[std::string("seconds_") + to_string(static_cast<StationState>(i))] = 0.0;
  }
  const StationGeometry& geometry = config_.geometry;
  pose_.position = geometry.position;
  pose_.position_sd_enu_m.setConstant(geometry.sd.position_m);
  pose_.position_source = pose_.tilt_source = PoseSource::kSurveyed;
  pose_.tilt_x_rad = geometry.chain.tilt_x_rad;
  pose_.tilt_y_rad = geometry.chain.tilt_y_rad;
  pose_.tilt_sd_rad = geometry.sd.tilt_rad;
  revision_pose_ = pose_;
}

void Station::set_pose(const StationPose& pose) {
  if (differs(revision_pose_, pose)) {
    revision_pose_ = pose;
    ++pose_revision_;
    counters_["pose_revisions"] += 1;
  }
  pose_ = pose;
  config_.geometry.position = pose.position;
  config_.geometry.chain.tilt_x_rad = pose.tilt_x_rad;
  config_.geometry.chain.tilt_y_rad = pose.tilt_y_rad;
  config_.geometry.sd.tilt_rad = pose.tilt_sd_rad;
}

void Station::enter(StationState state) {
  if (state == state_) return;
  state_ = state;
  acquisition_.clear();
  if (state == StationState::kTracking) in_view_ = {};
  counters_[std::string("entered_") + to_string(state)] += 1;
  believed_in_a_row_ = 0;
  // At the first frame of a search the tracker is told where to look.
  searched_s_ = -std::numeric_limits<double>::infinity();
}

bool Station::follows_target() const {
  return template_ != Template::kNone && state_ != StationState::kIdle &&
         state_ != StationState::kManual && state_ != StationState::kStopped &&
         state_ != StationState::kEmergency;
}

void Station::on_angles(const AngleSample& sample) { history_.add(sample); }

void Station::on_frame(const Frame& frame, double now_s) {
  if (now_s - frame.mid_exposure_s > config_.max_age_s) {
    counters_["frames_too_old"] += 1;
    return;
  }
  if (!frames_.empty() && frame.mid_exposure_s <= frames_.back().mid_exposure_s) {
    counters_["frames_out_of_order"] += 1;
    return;
  }
  frames_.push_back(frame);
  while (frame.mid_exposure_s - frames_.front().mid_exposure_s > config_.frame_memory_s) {
    frames_.pop_front();
  }
  if (follows_target()) {
    track(frame);
    drop_unproven(frame.mid_exposure_s);
  }
  note_in_view(frame);
  if (looks_for_anything()) acquire(frame);
}

TrackerInput Station::tracker_input(const Frame& frame) const {
  TrackerInput input{frame.gray, frame.mid_exposure_s, std::nullopt};
  if (tracked_s_) {
    const auto from = history_.at(*tracked_s_);
    const auto to = history_.at(frame.mid_exposure_s);
    if (from && to) {
      input.predicted_homography = rotation_homography(config_.geometry, from->angles, to->angles);
    }
  }
  return input;
}

void Station::track(const Frame& frame) {
  const TrackerInput input = tracker_input(frame);
  if (state_ == StationState::kSlewed && believed_in_a_row_ == 0 &&
      frame.mid_exposure_s - searched_s_ > config_.search_interval_s) {
    search_along_slew();
  }
  const TrackerResult result = tracker_->track(input);
  if (!result.output) {
    counters_[std::string("frames_refused_") + to_string(*result.error)] += 1;
    return;
  }
  tracked_s_ = frame.mid_exposure_s;
  last_output_ = result.output;
  counters_["frames_tracked"] += 1;
  compare_motion(*result.output);
  const bool there = state_ != StationState::kSlewed || is_where_slewed(frame, *result.output);
  if (!there) counters_["frames_elsewhere"] += 1;
  judge(there && result.output->belief >= config_.tracking_belief, frame.mid_exposure_s);
  if (state_ == StationState::kTracking && result.output->belief >= config_.tracking_belief) {
    waiting_.push_back({std::max(now_s_, frame.mid_exposure_s), frame.mid_exposure_s,
                        frame.stamp_sd_s, frame.stamp_source, *result.output, track_id_,
                        template_ == Template::kDesignated ? config_.designation_sd_px
                                                           : config_.acquisition_sd_px});
  }
}

// The camera's motion by the PTU's angles and by the picture: wrong angles, times or mounting show
// here before they show in a position.
void Station::compare_motion(const TrackerOutput& output) {
  if (output.prediction_dropped) counters_["predictions_dropped"] += 1;
  if (!output.prediction_error_px) return;
  const bool disagree = *output.prediction_error_px > config_.prediction_error_px;
  if (disagree) counters_["predictions_disagreeing"] += 1;
  disagreeing_in_a_row_ = disagree ? disagreeing_in_a_row_ + 1 : 0;
}

// Belief decides: one believed frame ends coasting (the tracker was still near), several in a row
// end a search.
void Station::judge(bool believed, double time_s) {
  believed_in_a_row_ = believed ? believed_in_a_row_ + 1 : 0;
  if (believed) believed_s_ = time_s;
  switch (state_) {
    case StationState::kTracking:
      if (!believed) enter(StationState::kCoasting);
      break;
    case StationState::kCoasting:
      if (believed) enter(StationState::kTracking);
      break;
    case StationState::kLost:
    case StationState::kSlewed:
      if (believed_in_a_row_ >= config_.reacquire_frames) {
        motion_.clear();
        if (template_ == Template::kUnproven) template_ = Template::kAcquired;
        own_.reset();
        enter(StationState::kTracking);
      }
      break;
    default:
      break;
  }
}

const Frame* Station::remembered(const std::optional<double>& time_s) const {
  if (frames_.empty()) return nullptr;
  if (!time_s) return &frames_.back();
  const auto nearest =
      std::min_element(frames_.begin(), frames_.end(), [&](const Frame& a, const Frame& b) {
        return std::abs(a.mid_exposure_s - *time_s) < std::abs(b.mid_exposure_s - *time_s);
      });
  constexpr double kSameFrame_s = 0.02;
  return std::abs(nearest->mid_exposure_s - *time_s) < kSameFrame_s ? &*nearest : nullptr;
}

std::optional<PanTilt> Station::reachable(const AzimuthElevation& direction) const {
  auto angles = aim_along(config_.geometry, direction);
  if (!angles) return std::nullopt;
  const auto newest = history_.newest();
  const PanTilt here = newest ? newest->angles : *angles;
  if (reach(config_.limits, here, *angles) == Reach::kUnreachable) return std::nullopt;
  return angles;
}

std::vector<Bearing> Station::step(double now_s) {
  if (now_s_ > 0.0 && now_s > now_s_) {
    counters_[std::string("seconds_") + to_string(state_)] += now_s - now_s_;
  }
  now_s_ = std::max(now_s_, now_s);
  expire(now_s_);
  std::vector<Bearing> bearings;
  while (!waiting_.empty()) {
    const Measured& measured = waiting_.front();
    const auto angles = history_.at(measured.mid_exposure_s);
    const bool bracketed = angles && angles->interpolated;
    if (!bracketed && now_s_ - measured.arrived_s < config_.angle_wait_s) break;
    if (auto made = bearing(measured); made && worth_sending(*made)) {
      constexpr double kSmoothing = 0.1;
      frame_latency_s_ += kSmoothing * (now_s_ - made->mid_exposure_s - frame_latency_s_);
      bearings.push_back(*made);
    }
    waiting_.pop_front();
  }
  return bearings;
}

void Station::expire(double now_s) {
  const bool slew_over = slew_ && now_s > slew_->received_s + slew_->lease_s;
  if (slew_over) slew_.reset();
  if (state_ == StationState::kSlewed && !slew_) {
    enter(template_ != Template::kNone ? StationState::kLost : StationState::kIdle);
  }
  const bool following = state_ == StationState::kTracking || state_ == StationState::kCoasting;
  // Also when frames stop coming: no believed frame, no motion.
  if (following && now_s - believed_s_ > config_.coast_s) {
    motion_.clear();
    enter(slew_ ? StationState::kSlewed : StationState::kLost);
  }
}

std::optional<Bearing> Station::bearing(const Measured& measured) {
  const auto angles = history_.at(measured.mid_exposure_s);
  if (!angles) {
    counters_["frames_without_angles"] += 1;
    return std::nullopt;
  }
  PixelSight pixel;
  pixel.pixel = measured.output.pixel;
  pixel.covariance_px2 = measured.output.covariance_px2;
  const double sd = measured.designation_sd_px;
  pixel.covariance_systematic_px2 = Eigen::Matrix2d::Identity() * (sd * sd);
  pixel.angles = angles->angles;
  // The frame's own stamp adds to the time jitter of the angles.
  const Eigen::Vector2d rate(angles->rate.pan_rad, angles->rate.tilt_rad);
  pixel.angles_covariance_rad2 =
      angles->covariance + rate * rate.transpose() * std::pow(measured.stamp_sd_s, 2);
  const auto line = sight(config_.geometry, pixel);
  if (!line) {
    counters_["pixels_outside_lens_model"] += 1;
    return std::nullopt;
  }
  Bearing result{measured.mid_exposure_s, *line,
                 measured.output.belief,  measured.track_id,
                 measured.stamp_sd_s,     measured.stamp_source};
  result.pose_revision = pose_revision_;
  result.sight.origin_sd_enu_m = pose_.position_sd_enu_m;
  follow(result, pixel);
  return result;
}

bool Station::worth_sending(const Bearing& bearing) {
  if (pose_.position_source == PoseSource::kNone) {
    counters_["bearings_without_pose"] += 1;
    return false;
  }
  if (now_s_ - bearing.mid_exposure_s > config_.max_age_s) {
    counters_["bearings_too_old"] += 1;
    return false;
  }
  counters_["bearings"] += 1;
  return true;
}

void Station::follow(const Bearing& bearing, const PixelSight& pixel) {
  auto centred = aim_along(config_.geometry, bearing.sight.direction);
  if (!centred) return;
  if (reach(config_.limits, pixel.angles, *centred) == Reach::kUnreachable) {
    counters_["target_beyond_travel"] += 1;  // the servo goes as far as it may
  }
  motion_.update(bearing.mid_exposure_s, *centred,
                 std::sqrt(bearing.sight.covariance_white.trace() / 2.0));
}

std::optional<ServoGoal> Station::slew_goal() const {
  constexpr double kStep_s = 0.05;
  const auto here = reachable(slew_->direction);
  const auto later = aim_along(config_.geometry, direction_at(*slew_, slew_->effect_s + kStep_s));
  if (!here || !later) return std::nullopt;
  const PanTilt rate{wrap_pi(later->pan_rad - here->pan_rad) / kStep_s,
                     (later->tilt_rad - here->tilt_rad) / kStep_s};
  return ServoGoal{slew_->effect_s, *here, rate, slew_->received_s + slew_->lease_s};
}

std::optional<ServoGoal> Station::goal(double now_s) const {
  switch (state_) {
    case StationState::kManual:
      if (point_) {
        ServoGoal here = *point_;  // does not move: as good now as when it was given
        here.time_s = now_s;
        return here;
      }
      return std::nullopt;
    case StationState::kTracking:
    case StationState::kCoasting:
      if (const auto angles = motion_.at(now_s)) {
        return ServoGoal{now_s, *angles, motion_.state()->rate, believed_s_ + config_.coast_s};
      }
      return std::nullopt;
    case StationState::kSlewed:
      if (slew_ && now_s <= slew_->received_s + slew_->lease_s) return slew_goal();
      return std::nullopt;
    default:
      return std::nullopt;
  }
}

std::optional<cv::Rect2d> Station::target_box() const {
  if (!last_output_ || !follows_target()) return std::nullopt;
  return last_output_->box;
}

StationSnapshot Station::snapshot() const {
  StationSnapshot snapshot;
  snapshot.state = state_;
  snapshot.track_id = track_id_;
  snapshot.angles = history_.newest();
  if (snapshot.angles) {
    snapshot.optical_axis = optical_axis(config_.geometry, snapshot.angles->angles);
  }
  const PanTilt angles = snapshot.angles ? snapshot.angles->angles : PanTilt{};
  snapshot.camera_ecef = camera_centre_ecef(config_.geometry, angles);
  if (last_output_ && follows_target()) {
    const auto& camera = config_.geometry.camera;
    snapshot.belief = last_output_->belief;
    snapshot.target_offset_px = last_output_->pixel - Eigen::Vector2d(camera.cx_px, camera.cy_px);
  }
  snapshot.box = target_box();
  snapshot.frame_latency_s = frame_latency_s_;
  snapshot.motion_disagrees =
      follows_target() && disagreeing_in_a_row_ >= config_.disagreeing_frames;
  snapshot.pose = pose_;
  if (auto words = slewed_in_vain(); !words.empty()) snapshot.alarms.push_back(std::move(words));
  if (slew_senders_.are_several(now_s_)) {
    snapshot.alarms.emplace_back("commands: slews from two fusions, end one of them");
  }
  snapshot.counters = counters_;
  return snapshot;
}

}  // namespace ols
