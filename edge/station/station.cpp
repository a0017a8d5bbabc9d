#include "edge/station/station.h"

#include <algorithm>
#include <cmath>

#include "conditions/alarms.h"
#include "edge/station/station_snapshot.h"
#include "edge/tracker/object_at.h"

namespace ols::station {
namespace {

// More than the error of any usable time stamp.
constexpr double kFuture_s = 0.2;

}  // namespace

Station::Station(const StationConfig& config, std::unique_ptr<tracker::TargetTracker> tracker)
    : config_(config),
      pointing_(config),
      frames_(config.frame_memory_s),
      target_(config, std::move(tracker)),
      search_(config),
      bearings_(config),
      detected_(config),
      motion_(config.motion),
      watch_(config.watch) {}

void Station::on_angles(const mount::AngleSample& sample) { pointing_.add(sample); }

void Station::on_frame(const camera::Frame& frame, double now_s) {
  if (now_s - frame.mid_exposure_s > config_.max_age_s) {
    counters_["frames_too_old"] += 1;
    return;
  }
  // Until that time has come, the mount would follow the track's extrapolation without pictures.
  if (frame.mid_exposure_s > now_s + kFuture_s) {
    counters_["frames_in_future"] += 1;
    return;
  }
  if (!frames_.add(frame)) {
    counters_["frames_out_of_order"] += 1;
    return;
  }
  if (follows_target()) {
    track(frame);
    drop_unproven(frame.mid_exposure_s);
  }
  if (mode_.is(StationState::kSlewed)) look_along_slew(frame);
  if (mode_.reference() != mount::Reference::kTrusted) return;
  std::optional<FollowedBox> followed;
  const auto* output =
      mode_.is(StationState::kTracking) ? target_.output_of(frame.mid_exposure_s) : nullptr;
  if (output) followed = {output->box, target_.track_id()};
  detected_.on_frame(frame, followed, now_s);
}

void Station::on_found(detector::Found found) {
  const camera::Frame* frame = detected_.looks_at();
  if (frame && found.motion) see(*found.motion, found.from_s, *frame);
  const auto new_track_id = [this] { return target_.new_track_id(); };
  for (PixelMeasurement& pixel : detected_.on_found(std::move(found), new_track_id, now_s_)) {
    bearings_.add(std::move(pixel));
  }
}

void Station::see(const tracker::ImageMotion& motion, double from_s, const camera::Frame& frame) {
  if (const auto turn = pointing_.add(motion, from_s, frame)) seen_turns_.push_back(*turn);
}

void Station::use(const StationGeometry& geometry,
                  const std::optional<StationCalibration>& calibration) {
  bearings_.clear();
  motion_.clear();
  pointing_.use(geometry, calibration);
  ++setup_revision_;
}

void Station::track(const camera::Frame& frame) {
  const auto led_to = this->led_to();
  if (is_led() && believed_in_a_row_ == 0) {
    const auto place = search_.send_tracker(frame, pointing_, led_to);
    if (place) target_.search_near(place->pixel, place->sd_px);
  }
  const auto before_s = target_.tracked_s();
  const auto output = target_.track(frame, pointing_);
  if (!output) return;
  if (before_s && output->image_motion) see(*output->image_motion, *before_s, frame);
  // A hidden target may reappear elsewhere; if other stations see it, the slew says where.
  const auto is_at = [&](const std::optional<SlewCommand>& slew) {
    return search_.is_where_slewed(frame, *output, pointing_, slew);
  };
  const bool there = !is_led() || is_at(led_to) || is_at(slew_.command());
  if (!there) counters_["frames_elsewhere"] += 1;
  const bool believed = output->belief >= config_.tracking_belief;
  if (there && believed) last_belief_ = output->belief;
  judge_belief(there && believed, frame.mid_exposure_s);
  if (mode_.is(StationState::kTracking) && believed) {
    bearings_.add({.arrived_s = std::max(now_s_, frame.mid_exposure_s),
                   .mid_exposure_s = camera::row_time_s(frame, output->pixel.y()),
                   .stamp_sd_s = frame.stamp_sd_s,
                   .stamp_source = frame.stamp_source,
                   .pixel = output->pixel,
                   .covariance_px2 = output->covariance_px2,
                   .belief = output->belief,
                   .track_id = target_.track_id(),
                   .designation_sd_px = target_.centring_sd_px(),
                   .acquired = !target_.is_designated(),
                   .detected = detected_.take_detection_of(target_.track_id())});
  }
}

// Belief decides: one believed frame ends coasting (the tracker was still near), several in a row
// end a search.
void Station::judge_belief(bool believed, double time_s) {
  believed_in_a_row_ = believed ? believed_in_a_row_ + 1 : 0;
  if (believed) believed_s_ = time_s;
  switch (mode_.state()) {
    case StationState::kTracking:
      if (!believed) enter(StationState::kCoasting);
      break;
    case StationState::kCoasting:
      if (believed) enter(StationState::kTracking);
      break;
    case StationState::kLost:
    case StationState::kSlewed:
    case StationState::kHidden:
      if (believed_in_a_row_ >= config_.reacquire_frames) {
        motion_.clear();
        target_.confirm();
        enter(StationState::kTracking);
      }
      break;
    default:
      break;
  }
}

void Station::drop_unproven(double time_s) {
  switch (target_.drop_unproven(time_s)) {
    case FollowedTarget::Dropped::kNothing:
      break;
    case FollowedTarget::Dropped::kBackToOwn:
      believed_in_a_row_ = 0;
      search_.end_trial(time_s);
      break;
    case FollowedTarget::Dropped::kNothingLeft:
      if (mode_.is(StationState::kLost)) enter(StationState::kIdle);
      break;
  }
}

void Station::look_along_slew(const camera::Frame& frame) {
  search_.note_in_view(frame, pointing_, slew_.command());
  if (!search_.looks_for_anything(target_)) return;
  const auto found =
      search_.acquire(frames_.frames(), detected_.newest(), pointing_, slew_.command());
  if (!found || !target_.try_found(*found->frame, found->box)) return;
  search_.begin_trial(*found);
  believed_in_a_row_ = 0;
  follow_since(found->frame->mid_exposure_s);
}

// What began in an older frame is tracked through the frames since then.
void Station::follow_since(double mid_exposure_s) {
  for (const camera::Frame* frame : frames_.since(mid_exposure_s)) {
    if (follows_target()) track(*frame);
  }
}

void Station::set_reference(mount::Reference reference) {
  const bool had_angles = !mode_.has_doubtful_angles();
  mode_.set_reference(reference);
  if (reference == mount::Reference::kUnknown) {
    manual_.clear();
    pointing_.forget_approach();
  }
  if (had_angles && mode_.has_doubtful_angles()) forget_angles();
}

// Earlier and later angles are not in the same frame of reference. A station that followed a target
// looks for it again.
void Station::forget_angles() {
  ++setup_revision_;
  pointing_.forget_angles();
  detected_.forget_angles();
  motion_.clear();
  bearings_.clear();
  target_.forget_angles();
  slew_.clear();
  occlusion_.clear();
  manual_.clear();
  if (mode_.is(StationState::kHidden) || follows_now()) {
    enter(StationState::kLost);
  }
}

void Station::enter(StationState state) {
  const bool was_led = is_led();
  if (!mode_.enter(state)) return;
  if (state == StationState::kHidden) hidden_since_s_ = now_s_;
  search_.restart(state == StationState::kTracking);
  if (!was_led || !is_led()) believed_in_a_row_ = 0;
}

void Station::pass_time(double now_s) { now_s_ = std::max(now_s_, now_s); }

Refusal Station::count(Refusal refusal, const char* command) {
  const bool accepted = refusal == Refusal::kNone;
  counters_[std::string(command) + (accepted ? "_accepted" : "_refused")] += 1;
  if (!accepted) counters_[std::string("refused_") + to_string(refusal)] += 1;
  return refusal;
}

Refusal Station::designate(const DesignateCommand& command, double now_s) {
  pass_time(now_s);
  const Refusal refusal = judge(command, situation(now_s));
  if (refusal != Refusal::kNone) return count(refusal, "designate");
  const camera::Frame* start = frames_.find(command.frame_time_s);
  if (start == nullptr) return count(Refusal::kNoFrame, "designate");
  const bool by_point = command.box.width == 0.0 && command.box.height == 0.0;
  const auto box = by_point ? tracker::object_at(start->gray, {command.box.x, command.box.y})
                            : std::optional(command.box);
  if (!box) return count(Refusal::kNothingThere, "designate");
  if (const auto error = target_.designate(*start, *box)) {
    const bool no_box = *error == tracker::TrackerError::kBox;
    return count(no_box ? Refusal::kBox : Refusal::kTracker, "designate");
  }
  believed_s_ = start->mid_exposure_s;
  motion_.clear();
  bearings_.clear();
  enter(StationState::kTracking);
  follow_since(start->mid_exposure_s);
  return count(Refusal::kNone, "designate");
}

Refusal Station::slew(const SlewCommand& command, double now_s) {
  pass_time(now_s);
  const Refusal refusal = judge(command, situation(now_s));
  // The station lets go of its object even if it cannot reach the direction.
  const bool frees = refusal == Refusal::kNone || refusal == Refusal::kUnreachable;
  if (refusal == Refusal::kNone && command.leads()) slew_.give(command, now_s_);
  if (frees && target_.let_go(command.let_go_track_id)) {
    motion_.clear();
    bearings_.clear();
    occlusion_.clear();
    const bool had_it =
        follows_now() || mode_.is(StationState::kHidden) || mode_.is(StationState::kLost);
    if (had_it) enter(StationState::kIdle);
  }
  if (refusal != Refusal::kNone) return count(refusal, "slew");
  if (command.leads() && (mode_.is(StationState::kIdle) || mode_.is(StationState::kLost))) {
    enter(StationState::kSlewed);
  }
  return count(Refusal::kNone, "slew");
}

Refusal Station::occlude(const OcclusionCommand& command, double now_s) {
  pass_time(now_s);
  const Refusal refusal = judge(command, situation(now_s));
  if (refusal != Refusal::kNone) return count(refusal, "occlusion");
  return count(occlusion_.give(command) ? Refusal::kNone : Refusal::kOvertaken, "occlusion");
}

Refusal Station::point(const PointCommand& command, double now_s) {
  pass_time(now_s);
  const Refusal refusal = judge(command, situation(now_s));
  if (refusal != Refusal::kNone) return count(refusal, "point");
  return stand_at(command.angles, "point", now_s);
}

Refusal Station::stand_at(const PanTilt& angles, const char* command, double now_s) {
  const auto there = pointing_.reachable(angles);
  if (!there) return count(Refusal::kUnreachable, command);
  manual_.point(*there, now_s, now_s + config_.point_time_s);
  enter(StationState::kManual);
  return count(Refusal::kNone, command);
}

Refusal Station::centre(const CentreCommand& command, double now_s) {
  pass_time(now_s);
  const Refusal refusal = judge_motion(situation(now_s));
  if (refusal != Refusal::kNone) return count(refusal, "centre");
  if (!command.pixel.allFinite()) return count(Refusal::kNotFinite, "centre");
  const camera::Frame* frame = frames_.find(command.frame_time_s);
  if (frame == nullptr) return count(Refusal::kNoFrame, "centre");
  const auto angles = pointing_.centring(command.pixel, frame->mid_exposure_s);
  return angles ? stand_at(*angles, "centre", now_s) : count(Refusal::kUnreachable, "centre");
}

Refusal Station::rate(const RateCommand& command, double now_s) {
  pass_time(now_s);
  const bool late = manual_.overtakes(command, now_s);
  const Refusal refusal = late ? Refusal::kOvertaken : judge(command, situation(now_s));
  if (refusal != Refusal::kNone) return count(refusal, "rate");
  manual_.turn(command);
  enter(StationState::kManual);
  return count(Refusal::kNone, "rate");
}

Refusal Station::lens(const LensCommand& command, double now_s) {
  pass_time(now_s);
  const Refusal refusal = judge(command, situation(now_s));
  if (refusal != Refusal::kNone) return count(refusal, "lens");
  add(command, actions_.lens);
  return count(Refusal::kNone, "lens");
}

void Station::begin_stopped() {
  actions_.stop = true;
  if (!mode_.is(StationState::kEmergency)) enter(StationState::kStopped);
}

// Cancels the goal of any command, and homing that has not begun.
void Station::give_up_unit() {
  slew_.clear();
  occlusion_.clear();
  manual_.clear();
  actions_.home = false;
}

// Also in an emergency: a stop must never be answered with a refusal.
void Station::stop(double now_s) {
  pass_time(now_s);
  give_up_unit();
  begin_stopped();
  mode_.note_stop(now_s);
  count(Refusal::kNone, "stop");
}

Refusal Station::release(double now_s) {
  pass_time(now_s);
  const Refusal refusal = mode_.refuses_operator(now_s);
  if (refusal != Refusal::kNone) return count(refusal, "release");
  if (mode_.is(StationState::kManual) || mode_.is(StationState::kStopped)) {
    manual_.clear();
    enter(target_.exists() ? StationState::kLost : StationState::kIdle);
  }
  return count(Refusal::kNone, "release");
}

void Station::emergency_stop(bool pressed, double now_s) {
  pass_time(now_s);
  mode_.set_pressed(pressed);
  if (!pressed || mode_.is(StationState::kEmergency)) return;
  give_up_unit();
  motion_.clear();
  bearings_.clear();
  enter(StationState::kEmergency);
}

Refusal Station::rearm(double now_s) {
  pass_time(now_s);
  const Refusal refusal = judge_rearm(situation(now_s));
  if (refusal == Refusal::kNone && mode_.is(StationState::kEmergency)) {
    enter(StationState::kStopped);
  }
  return count(refusal, "rearm");
}

Refusal Station::rearm_over_bus(double now_s) {
  const Refusal refusal = judge_rearm_over_bus(situation(now_s));
  if (refusal == Refusal::kNone) return rearm(now_s);
  pass_time(now_s);
  return count(refusal, "rearm");
}

Refusal Station::home(double now_s) {
  pass_time(now_s);
  const Refusal refusal = judge_home(situation(now_s));
  if (refusal == Refusal::kNone) {
    forget_angles();
    actions_.home = true;
  }
  return count(refusal, "home");
}

Refusal Station::reference_ok(double now_s) {
  pass_time(now_s);
  const Refusal refusal = judge_reference_ok(situation(now_s));
  if (refusal == Refusal::kNone) actions_.reference_ok = true;
  return count(refusal, "reference_ok");
}

StationOutput Station::step(double now_s) {
  if (now_s_ > 0.0 && now_s > now_s_) mode_.count_seconds(now_s - now_s_);
  pass_time(now_s);
  expire(now_s_);
  StationOutput output;
  for (const MadeBearing& made : bearings_.take(pointing_, now_s_)) {
    if (!made.bearing.is_tracklet()) follow(made);
    if (made.to_send) output.bearings.push_back(made.bearing);
  }
  output.goal = goal(now_s);
  output.watch = watch(now_s);
  return output;
}

// Also if the target has been lost for so long that nothing searches for it any more.
std::optional<mount::Goal> Station::watch(double now_s) {
  constexpr double kLost_s = 15.0, kNewest_s = 1.0;
  const bool free = mode_.reference() == mount::Reference::kTrusted &&
                    (mode_.is(StationState::kIdle) ||
                     (mode_.is(StationState::kLost) && now_s - believed_s_ > kLost_s));
  const auto& found = detected_.newest();
  const bool sees = found && !found->confirmed.empty() && now_s - found->mid_exposure_s < kNewest_s;
  return watch_.step(now_s, free, sees, pointing_);
}

StationState Station::without_target() const {
  if (occlusion_.command()) return StationState::kHidden;
  if (slew_.command()) return StationState::kSlewed;
  return target_.exists() ? StationState::kLost : StationState::kIdle;
}

std::optional<SlewCommand> Station::led_to() const {
  const auto exit = occlusion_.exit();
  return mode_.is(StationState::kHidden) && exit ? exit : slew_.command();
}

void Station::expire(double now_s) {
  slew_.expire(now_s);
  occlusion_.expire(now_s);
  if (is_led() || (mode_.is(StationState::kLost) && occlusion_.command())) enter(without_target());
  // Also when frames stop: without a believed frame there is no motion.
  if (follows_now() && now_s - believed_s_ > config_.coast_s) {
    motion_.clear();
    enter(without_target());
  }
}

void Station::follow(const MadeBearing& made) {
  if (!config_.moves) return;
  const LineOfSight& sight = made.bearing.sight;
  const auto centred = pointing_.aim_from(made.reported, sight.direction);
  if (!centred) return;
  const auto within = pointing_.reachable_from(made.reported, *centred);
  if (!within) counters_["target_beyond_travel"] += 1;  // the servo goes as far as it may
  motion_.update(made.bearing.mid_exposure_s, within.value_or(*centred),
                 std::sqrt(sight.covariance_white.trace() / 2.0));
}

std::optional<mount::Goal> Station::goal(double now_s) const {
  switch (mode_.state()) {
    case StationState::kManual:
      return manual_.goal(now_s);
    case StationState::kTracking:
    case StationState::kCoasting:
      if (const auto angles = motion_.at(now_s)) {
        return mount::Goal{now_s, *angles, motion_.state()->rate, believed_s_ + config_.coast_s};
      }
      return std::nullopt;
    case StationState::kSlewed:
      if (target_.on_trial() && slew_.searches_line()) return std::nullopt;
      return slew_.goal(pointing_, now_s);
    case StationState::kHidden:
      return occlusion_.exit() ? occlusion_.goal(pointing_, now_s) : slew_.goal(pointing_, now_s);
    default:
      return std::nullopt;
  }
}

std::optional<cv::Rect2d> Station::target_box() const {
  if (!target_.last_output() || !follows_target()) return std::nullopt;
  return target_.last_output()->box;
}

std::optional<video::VideoFrame> Station::video_frame(double mid_exposure_s) const {
  const camera::Frame* newest = frames_.find(std::nullopt);
  if (newest == nullptr || newest->mid_exposure_s != mid_exposure_s) return std::nullopt;
  return seen_in(*newest, parts());
}

std::optional<skyline::StatedPicture> Station::skyline_picture() const {
  if (mode_.reference() != mount::Reference::kTrusted) return std::nullopt;
  return station::skyline_picture(frames_.frames(), pointing_);
}

StationSnapshot Station::snapshot() const {
  StationSnapshot snapshot = snapshot_of(parts());
  snapshot.box = target_box();
  snapshot.frame_latency_s = bearings_.frame_latency_s();
  snapshot.alarms = alarms();
  snapshot.counters = counters();
  if (!mode_.is(StationState::kHidden)) return snapshot;
  snapshot.belief = last_belief_;
  snapshot.hidden_since_s = hidden_since_s_;
  if (const auto exit = occlusion_.exit()) snapshot.hidden_until_s = exit->effect_s;
  return snapshot;
}

std::vector<Alarm> Station::alarms() const {
  std::vector<Alarm> alarms;
  const bool slewed = mode_.is(StationState::kSlewed);
  const auto unacquired = slewed ? search_.unacquired_alarm(slew_.command()) : Alarm();
  if (!unacquired.empty()) alarms.push_back(unacquired);
  if (const Alarm beyond = watch_.alarm(); !beyond.empty()) alarms.push_back(beyond);
  if (slew_.has_several_senders(now_s_)) {
    alarms.push_back(alarm::slews_from_two_fusions());
  }
  return alarms;
}

// Each part uses its own counter names.
std::map<std::string, double> Station::counters() const {
  auto all = counters_;
  for (const auto* part : {&mode_.counters(), &target_.counters(), &search_.counters(),
                           &bearings_.counters(), &detected_.counters()}) {
    all.insert(part->begin(), part->end());
  }
  if (pointing_.pose_revision() > 0) {
    all["pose_revisions"] = static_cast<double>(pointing_.pose_revision());
  }
  return all;
}

}  // namespace ols::station
