// What operator, fusion and emergency stop tell a station.
#include <algorithm>
#include <cmath>

#include "edge/station.h"
#include "geometry/angles.h"
#include "geometry/slew_limits.h"

namespace ols {
namespace {

bool finite(const PanTilt& angles) {
  return std::isfinite(angles.pan_rad) && std::isfinite(angles.tilt_rad);
}

bool finite(const SlewCommand& slew) {
  for (const double value :
       {slew.effect_s, slew.received_s, slew.lease_s, slew.direction.azimuth_rad,
        slew.direction.elevation_rad, slew.azimuth_rate_rad_s, slew.elevation_rate_rad_s,
        slew.direction_sd_rad}) {
    if (!std::isfinite(value)) return false;
  }
  return true;
}

bool finite(const DesignateCommand& command) {
  for (const double value : {command.frame_time_s.value_or(0.0), command.box.x, command.box.y,
                             command.box.width, command.box.height}) {
    if (!std::isfinite(value)) return false;
  }
  return true;
}

bool in_range(const PanTilt& angles) {
  return std::abs(angles.pan_rad) <= kPointPanLimit_rad &&
         std::abs(angles.tilt_rad) <= kPointTiltLimit_rad;
}

bool in_range(const SlewCommand& command, double now_s, double lease_max_s) {
  return command.lease_s > 0.0 && command.lease_s <= lease_max_s &&
         std::abs(command.effect_s - now_s) <= kSlewLead_s &&
         std::abs(command.direction.azimuth_rad) <= 2.0 * kPi &&
         std::abs(command.direction.elevation_rad) <= kPi / 2.0 &&
         std::abs(command.azimuth_rate_rad_s) <= kSlewRateLimit_rad_s &&
         std::abs(command.elevation_rate_rad_s) <= kSlewRateLimit_rad_s &&
         command.direction_sd_rad >= 0.0 && command.direction_sd_rad <= kPi;
}

}  // namespace

Refusal Station::count(Refusal refusal, const char* command) {
  const bool accepted = refusal == Refusal::kNone;
  counters_[std::string(command) + (accepted ? "_accepted" : "_refused")] += 1;
  if (!accepted) counters_[std::string("refused_") + to_string(refusal)] += 1;
  return refusal;
}

Refusal Station::designate(const DesignateCommand& command, double now_s) {
  now_s_ = std::max(now_s_, now_s);
  if (state_ == StationState::kEmergency) return count(Refusal::kEmergency, "designate");
  if (stop_holds(now_s)) return count(Refusal::kJustStopped, "designate");
  if (!finite(command)) return count(Refusal::kNotFinite, "designate");
  const Frame* start = remembered(command.frame_time_s);
  if (start == nullptr) return count(Refusal::kNoFrame, "designate");
  const TrackerInput first{start->gray, start->mid_exposure_s, std::nullopt};
  if (const auto error = tracker_->initialise(first, command.box)) {
    const bool no_box = *error == TrackerError::kBox;
    return count(no_box ? Refusal::kBox : Refusal::kTracker, "designate");
  }
  track_id_ = ++last_track_id_;
  template_ = Template::kDesignated;
  own_.reset();
  tracked_s_ = believed_s_ = start->mid_exposure_s;
  last_output_.reset();
  motion_.clear();
  waiting_.clear();
  enter(StationState::kTracking);
  // The operator saw an old frame: catch up with the frames since then.
  const double start_s = start->mid_exposure_s;
  for (const Frame& frame : frames_) {
    if (frame.mid_exposure_s > start_s && follows_target()) track(frame);
  }
  return count(Refusal::kNone, "designate");
}

Refusal Station::judge(const SlewCommand& command, double now_s) const {
  if (state_ == StationState::kEmergency) return Refusal::kEmergency;
  if (!finite(command)) return Refusal::kNotFinite;
  if (!in_range(command, now_s, config_.slew_lease_max_s)) return Refusal::kOutOfRange;
  if (state_ == StationState::kManual || state_ == StationState::kStopped) {
    return Refusal::kPrecedence;
  }
  if (without_reference()) return Refusal::kNoReference;
  // On the whole way that this one command can lead, not only where it says it is.
  for (const double time_s : {now_s, command.effect_s, command.received_s + command.lease_s}) {
    if (!reachable(direction_at(command, time_s))) return Refusal::kUnreachable;
  }
  return Refusal::kNone;
}

Refusal Station::slew(const SlewCommand& command, double now_s) {
  now_s_ = std::max(now_s_, now_s);
  const Refusal refusal = judge(command, now_s);
  if (refusal != Refusal::kNone) return count(refusal, "slew");
  slew_ = command;
  slew_senders_.note(command.sender, now_s_);
  if (state_ == StationState::kIdle || state_ == StationState::kLost) {
    enter(StationState::kSlewed);
  }
  return count(Refusal::kNone, "slew");
}

Refusal Station::point(const PointCommand& command, double now_s) {
  now_s_ = std::max(now_s_, now_s);
  if (state_ == StationState::kEmergency) return count(Refusal::kEmergency, "point");
  if (stop_holds(now_s)) return count(Refusal::kJustStopped, "point");
  if (!finite(command.angles)) return count(Refusal::kNotFinite, "point");
  if (!in_range(command.angles)) return count(Refusal::kOutOfRange, "point");
  // It would go there whenever it comes, when nobody expects it any more.
  if (reference_ == PtuReference::kUnknown) return count(Refusal::kNoUnit, "point");
  if (without_reference()) return count(Refusal::kNoReference, "point");
  PanTilt angles = command.angles;
  const auto newest = history_.newest();
  if (reach(config_.limits, newest ? newest->angles : angles, angles) == Reach::kUnreachable) {
    return count(Refusal::kUnreachable, "point");
  }
  point_ = ServoGoal{now_s, angles, {}, now_s + config_.point_time_s};
  enter(StationState::kManual);
  return count(Refusal::kNone, "point");
}

void Station::begin_stopped() {
  stop_ = true;
  if (state_ != StationState::kEmergency) enter(StationState::kStopped);
}

bool Station::stop_holds(double now_s) const {
  return state_ == StationState::kStopped && stopped_s_ && now_s - *stopped_s_ < kStopHold_s;
}

// Also in an emergency: who says stop shall never read that it was refused.
void Station::stop(double now_s) {
  now_s_ = std::max(now_s_, now_s);
  slew_.reset();
  point_.reset();
  home_ = false;
  begin_stopped();
  stopped_s_ = now_s;
  count(Refusal::kNone, "stop");
}

Refusal Station::release(double now_s) {
  now_s_ = std::max(now_s_, now_s);
  if (state_ == StationState::kEmergency) return count(Refusal::kEmergency, "release");
  if (stop_holds(now_s)) return count(Refusal::kJustStopped, "release");
  if (state_ == StationState::kManual || state_ == StationState::kStopped) {
    point_.reset();
    enter(template_ != Template::kNone ? StationState::kLost : StationState::kIdle);
  }
  return count(Refusal::kNone, "release");
}

void Station::emergency_stop(bool pressed, double now_s) {
  now_s_ = std::max(now_s_, now_s);
  stop_pressed_ = pressed;
  if (!pressed || state_ == StationState::kEmergency) return;
  slew_.reset();
  point_.reset();
  motion_.clear();
  waiting_.clear();
  home_ = false;
  enter(StationState::kEmergency);
}

Refusal Station::rearm(double now_s) {
  now_s_ = std::max(now_s_, now_s);
  if (stop_pressed_) return count(Refusal::kEmergency, "rearm");
  if (state_ == StationState::kEmergency) enter(StationState::kStopped);
  return count(Refusal::kNone, "rearm");
}

Refusal Station::rearm_over_bus(double now_s) {
  now_s_ = std::max(now_s_, now_s);
  if (stop_pressed_) return count(Refusal::kEmergency, "rearm");
  if (!config_.rearm_over_bus) return count(Refusal::kRearmNeedsAHand, "rearm");
  return rearm(now_s);
}

bool Station::without_reference() const {
  return reference_ == PtuReference::kMissing || reference_ == PtuReference::kDoubted;
}

void Station::set_reference(PtuReference reference) {
  const bool had = !without_reference();
  reference_ = reference;
  if (reference == PtuReference::kUnknown) point_.reset();
  if (had && without_reference()) forget_angles();
}

// Angles of before and after are not in the same frame. Who followed a target looks for it again.
void Station::forget_angles() {
  history_.clear();
  motion_.clear();
  waiting_.clear();
  tracked_s_.reset();
  if (own_) own_->tracked_s.reset();
  slew_.reset();
  point_.reset();
  if (state_ == StationState::kTracking || state_ == StationState::kCoasting) {
    enter(StationState::kLost);
  }
}

Refusal Station::home(double now_s) {
  now_s_ = std::max(now_s_, now_s);
  if (state_ == StationState::kEmergency) return count(Refusal::kEmergency, "home");
  if (stop_holds(now_s)) return count(Refusal::kJustStopped, "home");
  if (!config_.homing_allowed) return count(Refusal::kKeepOut, "home");
  if (reference_ == PtuReference::kUnknown) return count(Refusal::kNoUnit, "home");
  forget_angles();
  home_ = true;
  return count(Refusal::kNone, "home");
}

Refusal Station::reference_ok(double now_s) {
  now_s_ = std::max(now_s_, now_s);
  if (state_ == StationState::kEmergency) return count(Refusal::kEmergency, "reference_ok");
  if (reference_ == PtuReference::kMissing) return count(Refusal::kNoReference, "reference_ok");
  if (reference_ != PtuReference::kDoubted) return count(Refusal::kNoDoubt, "reference_ok");
  reference_ok_ = true;
  return count(Refusal::kNone, "reference_ok");
}

}  // namespace ols
