#include "edge/process/station_process.h"

#include <algorithm>
#include <iterator>
#include <memory>
#include <utility>

#include "base/journal/journal.h"
#include "base/process/clocks.h"
#include "calibration/sky.h"
#include "conditions/alarms.h"
#include "edge/clock/clock_pair.h"
#include "edge/command/rearm_signal.h"
#include "edge/tracker/tracker.h"

namespace ols::station {
namespace {

constexpr double kFrameWait_s = 0.004;

std::string skyline_file(const StationSettings& settings) {
  if (settings.state_folder.empty()) return {};
  return settings.state_folder + "/" + settings.id + ".skyline";
}

skyline::SkylineOwner skyline_owner(const StationSettings& settings) {
  return {settings.id, settings.calibration_id,
          skyline::chain_hash(settings.station.geometry.chain)};
}

// A receiver without a first fix stays in the state "starting"; the station needs only camera and
// PTU.
gpio::LedPattern led_pattern(const StationReport& report) {
  if (report.snapshot.state == StationState::kEmergency) return gpio::LedPattern::kEmergency;
  if (!all_alarms(report).empty()) return gpio::LedPattern::kTrouble;
  const auto any = [&report](const auto& is) { return std::ranges::any_of(report.devices, is); };
  if (any([](const device::DeviceReport& device) {
        return device.state != device::DeviceState::kOk &&
               device.state != device::DeviceState::kStarting;
      })) {
    return gpio::LedPattern::kTrouble;
  }
  if (any([](const device::DeviceReport& device) {
        return device.state == device::DeviceState::kStarting &&
               (device.name == "camera" || device.name == "ptu");
      })) {
    return gpio::LedPattern::kStarting;
  }
  return report.snapshot.state == StationState::kTracking ? gpio::LedPattern::kTracking
                                                          : gpio::LedPattern::kReady;
}

}  // namespace

StationProcess::StationProcess(const StationSettings& configured, std::int64_t boot_id,
                               Outside outside)
    : calibration_(configured),
      clock_(settings().clock, std::move(outside.time_service)),
      pose_(std::in_place, settings(), clock_monotonic_s()),
      station_(settings().station,
               std::make_unique<tracker::Tracker>(settings().tracker, settings().tracker_seed)),
      command_turn_(station_),
      bus_(
          settings(), boot_id, station_, command_turn_,
          [this](const recorder::RecordCommand& command) { return record(command); },
          [this](const FrameRequest& wanted) { return frames_.service().request(wanted); }),
      host_(settings().host),
      persisted_(settings().state_folder, settings().id, settings().gpio.has_stop()),
      journal_(settings().id, write_to_journal),
      devices_(settings(), boot_id, outside.open_devices(settings())) {
  const DetectionConfig& detection = settings().station.detection;
  if (detection.enabled) detector_.emplace(detection.detector);
  if (!settings().land_folder.empty()) {
    skyline_.emplace(settings().land_folder, skyline_file(settings()), skyline_owner(settings()));
  }
  const double now_s = clock_monotonic_s();
  station_.set_pose(pose_->pose(now_s));
  resume_hold(now_s);
  // Ready means that subscriptions are active: a message sent after it is received.
  bus_.connect(BusConnector::kLongest_s);
}

void StationProcess::run(const std::function<bool()>& ends) {
  bool ready = false;
  while (!ends()) {
    turn();
    if (!ready) service_.ready("station " + settings().id + " begins");
    ready = true;
  }
  service_.stopping();
}

void StationProcess::turn() {
  const clock::ClockPair start = look_at_clocks();
  heed_emergency_stop(start.monotonic_s);
  heed_rearming(start.monotonic_s);
  receive_commands();
  persisted_.remember(station_.state(), devices_.mount().doubt_to_persist(),
                      devices_.mount().reference());
  if (const auto pose = pose_->look(devices_, start.monotonic_s)) station_.set_pose(*pose);
  take_zoom();
  const double waited_s = take_frame();
  take_angles();
  // Again, because the tracker takes time: publications carry the present time.
  const clock::ClockPair now = look_at_clocks();
  detect(now.monotonic_s);
  compare_skyline(now.monotonic_s);
  const StationOutput output = station_.step(now.monotonic_s);
  for (const Bearing& bearing : output.bearings) {
    bus_.send(bearing);
    // A sighting has no focal length, so none is sent with a zoom; and calibrations use designated
    // objects only.
    if (settings().station.zoom || bearing.is_tracklet()) continue;
    const std::int64_t utime_us = clock_.utime_us(bearing.mid_exposure_s);
    for (const Sighting& sighting : frames_.sightings(bearing, utime_us, station_.pointing()))
      bus_.send(sighting);
  }
  for (const mount::SeenTurn& turn : station_.take_seen_turns()) devices_.mount().see(turn);
  devices_.mount().set_goal(goal(output, now.monotonic_s));
  trigger_camera(now.monotonic_s);
  send_requested_frames(now);
  send_reports(now);
  host_.note_turn(clock_monotonic_s() - start.monotonic_s, waited_s);
  service_.alive(now.monotonic_s);
}

clock::ClockPair StationProcess::look_at_clocks() {
  const clock::ClockPair now = clock_.look();
  bus_.set_time(now, clock_.quality(now.monotonic_s));
  return now;
}

// A station that was stopped when its process ended stays stopped: a restart does not permit
// motion.
void StationProcess::resume_hold(double now_s) {
  devices_.mount().restore_doubt(persisted_.doubt());
  halted_ = !devices_.stop().known();
  if (persisted_.begin() == StationState::kStopped) station_.begin_stopped();
  if (persisted_.begin() != StationState::kEmergency) return;
  devices_.mount().emergency_halt();
  station_.emergency_stop(true, now_s);
}

// The GPIO thread has halted the unit already; here the station follows.
void StationProcess::heed_emergency_stop(double now_s) {
  StopLatch& stop = devices_.stop();
  if (!stop.known()) return;
  if (stop.take_press()) station_.emergency_stop(true, now_s);
  station_.emergency_stop(stop.pressed(), now_s);
  halted_ = halted_ || station_.state() == StationState::kEmergency;
}

// Re-arming is by the button, or by a user logged in on the station's computer.
void StationProcess::heed_rearming(double now_s) {
  const bool button = devices_.stop().take_rearm();
  const bool signal = take_rearm_signal();
  if (!button && !signal) return;
  const std::string by = button ? "its button" : "a signal";
  if (!devices_.stop().known() || station_.rearm(now_s) != Refusal::kNone) {
    const char* why = "the stop is pressed, or its level is not known yet";
    write_to_journal({.text = "re-arming by " + by + " refused: " + why,
                      .bad = true,
                      .id = event::kCommandRefused,
                      .station = settings().id,
                      .reason = why});
  } else {
    write_to_journal({.text = "re-arming by " + by + ": " + to_string(station_.state()),
                      .id = event::kRearmed,
                      .station = settings().id});
  }
}

void StationProcess::receive_commands() {
  station_.set_reference(devices_.mount().reference());
  bus_.receive();
  devices_.mount().allow_rehoming(!is_held(station_.state()));
  const UnitActions actions = station_.take_actions();
  if (actions.stop) devices_.mount().stop_homing();
  if (actions.home) devices_.mount().home();
  if (actions.reference_ok) devices_.mount().reference_ok();
  if (auto* lens = devices_.lens()) lens->order(actions.lens);
  const bool may_move = devices_.stop().known() && station_.state() != StationState::kEmergency;
  if (halted_ && may_move) {
    halted_ = false;
    devices_.rearm();
  }
}

double StationProcess::take_frame() {
  const double asked_s = clock_monotonic_s();
  auto frame = devices_.camera().next(kFrameWait_s);
  const double waited_s = clock_monotonic_s() - asked_s;
  if (!frame) return waited_s;
  if (auto& recorder = devices_.recorder()) {
    recorder->add(*frame, clock_.utime_us(frame->mid_exposure_s));
  }
  take_angles();  // first: they predict the frame's homography
  frames_.service().on_frame(*frame);
  station_.on_frame(*frame, clock_monotonic_s());
  calibration_.see(*frame);
  devices_.camera().set_region(station_.target_box());
  show_frame(*frame);
  newest_ = std::move(frame);
  return waited_s;
}

void StationProcess::show_frame(const camera::Frame& frame) {
  auto& video = devices_.video();
  if (!video || !video->has_viewers()) return;
  auto shown = station_.video_frame(frame.mid_exposure_s);
  if (!shown) return;
  shown->utime_us = clock_.utime_us(frame.mid_exposure_s);
  video->offer(std::move(*shown));
}

bool StationProcess::is_night(double now_s) {
  constexpr double kInterval_s = 60.0;
  if (now_s < night_judged_s_ + kInterval_s) return is_night_;
  night_judged_s_ = now_s;
  const sensors::StationPose pose = pose_->pose(now_s);
  if (pose.position_source == sensors::PoseSource::kNone) return is_night_ = false;
  const Geodetic& place = pose.position;
  const auto sun = calibration::sun_direction(clock_.utime_us(now_s), place,
                                              calibration::standard_air(place.height_m), {});
  return is_night_ = sun.elevation_rad < 0.0;
}

void StationProcess::detect(double now_s) {
  if (!detector_) return;
  if (auto found = detector_->take()) station_.on_found(std::move(*found));
  if (auto picture = station_.picture_to_search(now_s, is_night(now_s)))
    detector_->give(std::move(*picture));
}

void StationProcess::compare_skyline(double now_s) {
  if (!skyline_) return;
  skyline_->follow(station_.setup_revision(), skyline_owner(settings()));
  if (const auto part = skyline_->next_part(now_s)) bus_.send(*part);
  if (!skyline_->wants(now_s)) return;
  auto picture = station_.skyline_picture();
  if (!picture) return;
  picture->utime_us = clock_.utime_us(picture->mid_exposure_s);
  skyline_->give(*std::move(picture));
}

void StationProcess::take_zoom() {
  auto* lens = devices_.lens();
  if (lens == nullptr) return;
  for (const lens::ZoomSample& sample : lens->take_samples()) station_.on_zoom(sample);
  station_.set_lens(lens->positions());
}

void StationProcess::take_angles() {
  station_.set_reference(devices_.mount().reference());
  for (const mount::AngleSample& sample : devices_.mount().take_samples()) {
    station_.on_angles(sample);
  }
}

// A check of the reference views gets the unit only while no goal needs it, but before the watch.
std::optional<mount::Goal> StationProcess::goal(const StationOutput& output, double now_s) {
  const auto newest = station_.reported_angles();
  const bool free = settings().station.moves && station_.state() == StationState::kIdle &&
                    !output.goal && !halted_ &&
                    devices_.mount().reference() == mount::Reference::kTrusted;
  const auto check = calibration_.step({now_s, free, newest});
  if (const auto doubt = calibration_.take_doubt()) {
    station_.doubt_setup(doubt->heading_rad, doubt->tilt_rad);
  }
  if (output.goal) return output.goal;
  return check || halted_ ? check : output.watch;
}

void StationProcess::trigger_camera(double now_s) {
  const bool by_line = settings().gpio.trigger_line >= 0;
  const bool by_software = settings().camera->config().trigger == camera::TriggerMode::kSoftware;
  if (now_s < due_.trigger_s || (!by_line && !by_software)) return;
  const double period_s = 1.0 / settings().camera->config().frame_rate_hz;
  // At the configured rate, without a burst after a pause.
  due_.trigger_s = std::max(due_.trigger_s + period_s, now_s);
  if (by_software) devices_.camera().trigger();
  if (by_line) devices_.gpio()->trigger();
}

// Few parts per turn: sending a frame of a megabyte takes tens of milliseconds.
void StationProcess::send_requested_frames(const clock::ClockPair& now) {
  constexpr int kParts = 2;
  frames_.look(now, station_.pointing());
  for (int i = 0; i < kParts; ++i) {
    const auto part = frames_.next();
    if (!part) return;
    bus_.send(*part);
  }
}

void StationProcess::send_reports(const clock::ClockPair& now) {
  if (now.monotonic_s >= due_.status_s) {
    due_.status_s = now.monotonic_s + settings().status_interval_s;
    StationReport status = report(now);
    show(status);
    bus_.send(std::move(status));
  }
  if (settings().preview_interval_s > 0.0 && now.monotonic_s >= due_.preview_s && newest_) {
    due_.preview_s = now.monotonic_s + settings().preview_interval_s;
    bus_.send_preview(*newest_, station_.target_box());
  }
}

StationReport StationProcess::report(const clock::ClockPair& now) {
  StationReport report;
  const auto limits = devices_.mount().limits();
  if (limits) {
    station_.set_limits(*limits);
    calibration_.set_limits(*limits);
  }
  report.limits = limits.value_or(settings().station.limits);
  report.limits_known = limits.has_value();
  report.snapshot = station_.snapshot();
  report.devices = devices_.reports();
  if (!settings().software.empty()) report.devices.push_back(software());
  check_calibration(report, now.monotonic_s);
  calibration_.note_homings(devices_.mount().homings());
  report.calibration = calibration_.status();
  report.counters.merge(calibration_.counters());
  report.alarms = report.snapshot.alarms;
  if (report.snapshot.state == StationState::kEmergency) {
    report.alarms.push_back(emergency_alarm());
  }
  if (report.snapshot.motion_disagrees) {
    report.alarms.push_back(alarm::ptu_contradicts_image());
  }
  for (const Alarm& alarm : calibration_.alarms()) report.alarms.push_back(alarm);
  for (const Alarm& alarm : ActiveCalibration::other_devices(settings().serials, report.devices)) {
    report.alarms.push_back(alarm);
  }
  if (skyline_) std::ranges::move(skyline_->alarms(), std::back_inserter(report.alarms));
  for (const Alarm& alarm : persisted_.alarms()) report.alarms.push_back(alarm);
  for (const Alarm& alarm : bus_.alarms()) report.alarms.push_back(alarm);
  add_pose_and_clock(now.monotonic_s, report);
  add_host(now.monotonic_s, report);
  journal_.note(now, {settings().lcm_url, bus_.trouble(), bus_.last_refusal(), bus_.refusals()},
                report);
  return report;
}

// Refuses a calibration that is not that of the open devices. Once the station is idle, adopts one
// that was accepted meanwhile.
void StationProcess::check_calibration(const StationReport& report, double now_s) {
  const PanTilt count = report.limits_known ? report.limits.count : PanTilt{};
  const bool idle = report.snapshot.state == StationState::kIdle;
  const bool other = calibration_.adopts(now_s, idle, report.devices, count) ||
                     calibration_.refuses(count) || calibration_.refuses(report.devices);
  if (!other) return;
  station_.use(settings().station.geometry, settings().station.calibration);
  pose_.emplace(settings(), now_s);
  station_.set_pose(pose_->pose(now_s));
}

// A device and no new field: a new field would change the message's type, and older logs and
// programs would no longer match.
device::DeviceReport StationProcess::software() const {
  device::DeviceReport report;
  report.name = "software";
  report.state = device::DeviceState::kOk;
  report.text = settings().software;
  return report;
}

Alarm StationProcess::emergency_alarm() const {
  if (devices_.stop().pressed()) return alarm::emergency_stop_pressed();
  const gpio::GpioConfig& gpio = settings().gpio;
  std::string how =
      "on its computer, systemctl kill --kill-who=main -s USR1 ols-station@" + settings().id;
  if (!gpio.chip.empty() && gpio.rearm_line >= 0) how = "hold its re-arm button";
  if (gpio.rearm_over_bus) how = "ols-ctl " + settings().id + " rearm";
  return alarm::emergency_stop_not_rearmed(how);
}

void StationProcess::add_pose_and_clock(double now_s, StationReport& report) const {
  for (const Alarm& alarm : pose_->alarms(now_s)) report.alarms.push_back(alarm);
  const clock::ClockQuality clock = clock_.quality(now_s);
  if (!clock.alarm.empty()) report.alarms.push_back(clock.alarm);
  report.counters["clock_steps"] = static_cast<double>(clock.steps);
  if (clock.offset_s) report.readings["clock_offset_s"] = *clock.offset_s;
  if (settings().site.number > 0) {
    report.readings["site_settings_number"] = static_cast<double>(settings().site.number);
  }
}

void StationProcess::add_host(double now_s, StationReport& report) {
  HostReport host = host_.look(now_s);
  report.alarms.insert(report.alarms.end(), host.alarms.begin(), host.alarms.end());
  report.readings.merge(host.readings);
  report.counters["slow_turns"] = static_cast<double>(host_.slow_turns());
  if (detector_) report.readings["detector_image_s"] = detector_->picture_s();
}

void StationProcess::show(const StationReport& report) {
  if (auto* gpio = devices_.gpio()) gpio->show(led_pattern(report));
  service_.status((bus_.trouble().empty() ? "" : "no bus; ") + in_one_line(report));
}

std::string StationProcess::record(const recorder::RecordCommand& command) {
  auto& recorder = devices_.recorder();
  return recorder ? recorder->record(command) : "this station records nothing";
}

}  // namespace ols::station
