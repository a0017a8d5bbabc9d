#include "sim/lockstep_station.h"

#include <algorithm>
#include <cmath>

#include "edge/tracker/tracker.h"

namespace ols::sim {
namespace {

constexpr double kBoot_s = 100.0;         // of the monotonic clock at the scenario's start
constexpr double kStampSd_s = 20e-6;      // of the camera's time stamps
constexpr double kTransport_s = 0.004;    // of a frame over the wire
constexpr double kOperatorDelay_s = 0.3;  // what the operator sees is as old as this
constexpr double kPointInterval_s = 2.0, kPointLead_s = 1.2;
constexpr double kStill_s = 0.1;   // nobody marks a target in a sweeping picture
constexpr double kSettle_s = 1.5;  // from the PTU's readiness to the first look
constexpr std::uint64_t kStationTag = 5000, kUnitTag = 6000, kTrackerTag = 7000;

PtuConfig driver_config(const World& world) {
  PtuConfig config;
  config.baud = world.scenario().ptu.baud;
  config.poll_interval_s = world.scenario().ptu.poll_interval_s;
  return config;
}

StationConfig station_config(const World& world, std::size_t index) {
  StationConfig config;
  config.geometry = world.stations()[index].nominal;
  config.angles.step_rad = radians(world.ptu_unit_config().resolution_arcsec / 3600.0);
  return config;
}

std::unique_ptr<TargetTracker> make_tracker(const Fidelity& fidelity, const ViewMemory& views,
                                            std::uint64_t seed) {
  if (!fidelity.pictures) return std::make_unique<ViewTracker>(views, fidelity.pixel_sd_px, seed);
  return std::make_unique<Tracker>(TrackerConfig{}, seed);
}

bool inside_third(const CameraIntrinsics& camera, const ViewTruth& view) {
  return view.visible && std::abs(view.centre_px.x() - camera.cx_px) < camera.width_px / 6.0 &&
         std::abs(view.centre_px.y() - camera.cy_px) < camera.height_px / 6.0;
}

}  // namespace

double LockstepStation::monotonic_s(double time_s) { return kBoot_s + time_s; }

LockstepStation::LockstepStation(const World& world, std::size_t index, const Fidelity& fidelity,
                                 std::unique_ptr<Renderer> renderer)
    : world_(world),
      index_(index),
      fidelity_(fidelity),
      renderer_(std::move(renderer)),
      generator_(derived_seed(world.seed(), kStationTag + index)),
      unit_(world.ptu_unit_config(), derived_seed(world.seed(), kUnitTag + index), kBoot_s),
      driver_(driver_config(world)),
      config_(station_config(world, index)),
      station_(config_,
               make_tracker(fidelity, views_, derived_seed(world.seed(), kTrackerTag + index))) {
  left_alone_ = std::count(fidelity.not_designated.begin(), fidelity.not_designated.end(),
                           world.stations()[index].id) > 0;
  std::uniform_real_distribution<double> uniform;
  phase_s_ = uniform(generator_) / world.scenario().frame_rate_hz;
  constexpr double kRoughly_rad = 0.3 * kPi / 180.0;
  aiming_error_.pan_rad = kRoughly_rad * (2.0 * uniform(generator_) - 1.0);
  aiming_error_.tilt_rad = kRoughly_rad * (2.0 * uniform(generator_) - 1.0);
}

std::vector<Bearing> LockstepStation::advance(double time_s) {
  exchange_bytes(time_s);
  for (const AngleSample& sample : driver_.take_samples()) station_.on_angles(sample);
  expose(time_s);
  operate(time_s);
  const double now_s = monotonic_s(time_s);
  StationOutput output = station_.step(now_s);
  driver_.set_goal(output.goal);
  return std::move(output.bearings);
}

void LockstepStation::exchange_bytes(double time_s) {
  const double now_s = monotonic_s(time_s);
  const double first_s = std::min(unit_.next_output_s().value_or(now_s), now_s);
  const std::string answer = unit_.transmit(now_s);
  if (!answer.empty()) driver_.receive(answer, first_s);
  const std::string request = driver_.step(now_s);
  if (!request.empty()) unit_.receive(request, now_s);
}

void LockstepStation::expose(double time_s) {
  const Scenario& s = world_.scenario();
  const double mid_s = phase_s_ + static_cast<double>(next_frame_) / s.frame_rate_hz;
  if (time_s < mid_s + 0.5 * s.exposure_s + s.readout_s + kTransport_s) return;
  const std::int64_t number = next_frame_++;
  const bool lost = std::uniform_real_distribution<double>()(generator_) < s.errors.frames.lost;
  const double stamp_s = monotonic_s(mid_s) + kStampSd_s * normal_(generator_);
  ExposureTruth exposure;
  exposure.mid_s = mid_s;
  exposure.exposure_s = s.exposure_s;
  exposure.frame = static_cast<std::uint64_t>(number);
  exposure.start = unit_.angles_at(monotonic_s(mid_s - 0.5 * s.exposure_s));
  exposure.mid = unit_.angles_at(monotonic_s(mid_s));
  exposure.end = unit_.angles_at(monotonic_s(mid_s + 0.5 * s.exposure_s));
  if (s.errors.frames.on && lost) {
    record_.frames_lost += 1;
    return;
  }
  Frame frame;
  frame.mid_exposure_s = stamp_s;
  frame.stamp_sd_s = kStampSd_s;
  frame.number = exposure.frame;
  const ViewTruth view =
      renderer_ ? renderer_->draw(exposure, frame.gray) : view_truth(world_, index_, exposure);
  views_.add(stamp_s, view);
  seen_.push_back({stamp_s, exposure, view});
  if (mid_s - seen_.front().exposure.mid_s > 1.0) seen_.pop_front();
  station_.on_frame(frame);
  if (designated_ || left_alone_) take_note(mid_s, view);
}

void LockstepStation::take_note(double mid_s, const ViewTruth& view) {
  const CameraIntrinsics& camera = config_.geometry.camera;
  const StationSnapshot snapshot = station_.snapshot();
  FrameNote note{mid_s,        snapshot.state, snapshot.belief, view, inside_third(camera, view),
                 std::nullopt, snapshot.box,   snapshot.alarms};
  if (snapshot.state == StationState::kTracking && snapshot.target_offset_px) {
    note.error_px =
        *snapshot.target_offset_px + Eigen::Vector2d(camera.cx_px, camera.cy_px) - view.centre_px;
  }
  record_.frames.push_back(note);
}

void LockstepStation::operate(double time_s) {
  station_.set_reference(driver_.reference());
  if (designated_ || driver_.state() != PtuState::kReady) return;
  if (ready_s_ < 0.0) {
    ready_s_ = time_s;
    station_.set_limits(driver_.limits());
  }
  if (left_alone_) return;
  if (pointed_s_ < 0.0 || time_s - pointed_s_ > kPointInterval_s) point_roughly(time_s);
  if (time_s - ready_s_ > kSettle_s) designate_seen(time_s);
}

void LockstepStation::point_roughly(double time_s) {
  const TargetTruth target = world_.target(0, time_s + kPointLead_s);
  auto angles = aim_at(config_.geometry, target.p_ecef);
  if (!angles) return;
  angles->pan_rad += aiming_error_.pan_rad;
  angles->tilt_rad += aiming_error_.tilt_rad;
  station_.point({*angles}, monotonic_s(time_s));
  pointed_s_ = time_s;
}

bool LockstepStation::stands_since(double from_s, double time_s) const {
  constexpr double kStanding_rad = 1e-3;
  const PanTilt then = unit_.angles_at(monotonic_s(from_s));
  const PanTilt now = unit_.angles_at(monotonic_s(time_s));
  return std::hypot(now.pan_rad - then.pan_rad, now.tilt_rad - then.tilt_rad) < kStanding_rad;
}

void LockstepStation::designate_seen(double time_s) {
  constexpr double kMargin_px = 60.0;
  const auto frame = std::find_if(seen_.rbegin(), seen_.rend(), [&](const Seen& seen) {
    return time_s - seen.exposure.mid_s >= kOperatorDelay_s;
  });
  if (frame == seen_.rend() || !frame->view.visible || !seen_.back().view.visible) return;
  if (!stands_since(frame->exposure.mid_s - kStill_s, time_s)) return;
  const Eigen::Vector2d c = frame->view.centre_px;
  const auto& camera = config_.geometry.camera;
  if (c.x() < kMargin_px || c.y() < kMargin_px || c.x() > camera.width_px - kMargin_px ||
      c.y() > camera.height_px - kMargin_px) {
    return;
  }
  auto box = marked(*frame);
  if (!box) return;
  box->x += config_.designation_sd_px * normal_(generator_);
  box->y += config_.designation_sd_px * normal_(generator_);
  designated_ = station_.designate({frame->stamp_s, *box}, monotonic_s(time_s)) == Refusal::kNone;
}

StationRecord LockstepStation::record() const {
  StationRecord record = record_;
  record.counters = station_.snapshot().counters;
  const PtuCounters& ptu = driver_.counters();
  record.counters.merge(std::map<std::string, double>{
      {"ptu_requests", static_cast<double>(ptu.requests)},
      {"ptu_replies", static_cast<double>(ptu.replies)},
      {"ptu_timeouts", static_cast<double>(ptu.timeouts)},
      {"ptu_refused_positions", static_cast<double>(ptu.refused_positions)},
      {"ptu_limit_hits", static_cast<double>(ptu.limit_hits)}});
  return record;
}

// The target's box, or what this operator takes for it; nothing: it is not in the picture.
std::optional<cv::Rect2d> LockstepStation::marked(const Seen& seen) const {
  const std::string& id = world_.stations()[index_].id;
  const auto wrong = std::ranges::find(fidelity_.misdesignated, id, &Misdesignation::station);
  if (wrong == fidelity_.misdesignated.end()) return seen.view.box;
  const ViewTruth view = view_truth(world_, index_, seen.exposure, wrong->target);
  if (!view.visible) return std::nullopt;
  const cv::Rect2d& box = view.box;
  const double grown = 0.5 * (wrong->scale - 1.0);
  return cv::Rect2d(box.x + wrong->off_px.x() - grown * box.width,
                    box.y + wrong->off_px.y() - grown * box.height, wrong->scale * box.width,
                    wrong->scale * box.height);
}

Refusal LockstepStation::slew(SlewCommand command, double time_s) {
  command.received_s = monotonic_s(time_s);
  return station_.slew(command, command.received_s);
}

}  // namespace ols::sim
