#include "sim/lockstep/lockstep_station.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "edge/mount/fixed/fixed_kind.h"
#include "edge/mount/onvif/onvif_kind.h"
#include "edge/tracker/tracker.h"
#include "sim/onvif/onvif_in_hand.h"
#include "sim/scenario/onvif_camera.h"

namespace ols::sim {
namespace {

constexpr double kZoomSd = 0.001, kZoomPoll_s = 0.05;
constexpr double kStampSd_s = 20e-6;    // of the camera's time stamps
constexpr double kTransport_s = 0.004;  // of a frame over the wire
constexpr double kDetection_s = 0.03;   // of an image
constexpr std::uint64_t kStationTag = 5000, kUnitTag = 6000, kTrackerTag = 7000;

station::StationConfig station_config(const World& world, std::size_t index, bool pictures,
                                      const std::optional<StationCalibration>& calibration) {
  station::StationConfig config;
  config.geometry = calibration ? calibration->model.geometry : world.stations()[index].nominal;
  config.calibration = calibration;
  config.designation_sd_px = world.scenario().errors.designation.stated_sd_px();
  config.overview = world.scenario().stations[index].overview;
  config.detection.enabled = pictures && world.scenario().detector_on;
  const StationScenario& scenario = world.scenario().stations[index];
  config.watch = {.middle = scenario.watch, .size_rad = scenario.watch_size_rad};
  const auto& points = world.stations()[index].zoom_points;
  if (!points.empty()) config.zoom.emplace(ZoomTable(points), kZoomSd);
  if (const auto& fixed = world.scenario().stations[index].fixed) {
    mount::FixedKind kind;
    kind.fixed.angles = *fixed;
    config.angles = kind.traits().angles;
    config.moves = false;
  } else if (scenario.mount == MountModel::kOnvif) {
    onvif::OnvifKind kind;
    kind.onvif.drive = drive_config(onvif_config(world.scenario(), scenario).unit);
    config.angles = kind.traits().angles;
  } else {
    config.angles.step_rad = radians(world.ptu_unit_config().resolution_arcsec / 3600.0);
  }
  return config;
}

std::unique_ptr<tracker::TargetTracker> make_tracker(const Fidelity& fidelity,
                                                     const ViewMemory& views, std::uint64_t seed) {
  if (!fidelity.pictures) return std::make_unique<ViewTracker>(views, fidelity.pixel_sd_px, seed);
  return std::make_unique<tracker::Tracker>(tracker::TrackerConfig{}, seed);
}

bool inside_third(const CameraIntrinsics& camera, const ViewTruth& view) {
  return view.visible && std::abs(view.centre_px.x() - camera.cx_px) < camera.width_px / 6.0 &&
         std::abs(view.centre_px.y() - camera.cy_px) < camera.height_px / 6.0;
}

}  // namespace

LockstepStation::LockstepStation(const World& world, std::size_t index, const Fidelity& fidelity,
                                 std::unique_ptr<Renderer> renderer,
                                 const std::optional<StationCalibration>& calibration)
    : world_(world),
      index_(index),
      renderer_(std::move(renderer)),
      noise_(derived_seed(world.seed(), kStationTag + index)),
      shutter_{noise_.uniform() / world.scenario().frame_rate_hz},
      mount_(make_lockstep_mount(world, index, derived_seed(world.seed(), kUnitTag + index),
                                 monotonic_s(0.0))),
      exposed_(world.stations()[index].unit, world.ptu_unit_config()),
      config_(station_config(world, index, fidelity.pictures, calibration)),
      station_(config_,
               make_tracker(fidelity, views_, derived_seed(world.seed(), kTrackerTag + index))),
      operator_(world, index, fidelity, noise_, *mount_, station_) {
  if (config_.detection.enabled) {
    detection_.emplace(Detection{detector::PictureDetector(config_.detection.detector)});
  }
  const ZoomScenario& zoom = world.scenario().stations[index].zoom;
  if (zoom.is_fixed()) return;
  lens_.emplace(Lens{LensUnit({.zoom_travel_s = zoom.travel_s}, monotonic_s(0.0)),
                     lens::LensDriver(kZoomPoll_s)});
}

std::vector<station::Bearing> LockstepStation::advance(double time_s) {
  mount_->advance(monotonic_s(time_s));
  for (const mount::AngleSample& sample : mount_->take_samples()) station_.on_angles(sample);
  move_lens(time_s);
  expose(time_s);
  operate(time_s);
  detect(time_s);
  const double now_s = monotonic_s(time_s);
  station::StationOutput output = station_.step(now_s);
  for (const mount::SeenTurn& turn : station_.take_seen_turns()) mount_->see(turn);
  mount_->set_goal(output.goal ? output.goal : output.watch);
  return std::move(output.bearings);
}

void LockstepStation::move_lens(double time_s) {
  const station::UnitActions actions = station_.take_actions();
  if (!lens_) return;
  const double now_s = monotonic_s(time_s);
  lens_->driver.order(actions.lens);
  lens_->unit.receive(lens_->driver.step(now_s), now_s);
  lens_->driver.receive(lens_->unit.transmit(now_s), now_s);
  for (const lens::ZoomSample& sample : lens_->driver.take_samples()) station_.on_zoom(sample);
  station_.set_lens(lens_->driver.state().positions);
}

void LockstepStation::expose(double time_s) {
  const Scenario& s = world_.scenario();
  const double mid_s = shutter_.phase_s + static_cast<double>(shutter_.next) / s.frame_rate_hz;
  if (time_s < mid_s + 0.5 * s.exposure_s + s.readout_s + kTransport_s) return;
  const std::int64_t number = shutter_.next++;
  const bool lost = noise_.uniform() < s.errors.frames.lost;
  const double stamp_s = monotonic_s(mid_s) + kStampSd_s * noise_.gaussian();
  ExposureTruth exposure;
  exposure.mid_s = mid_s;
  exposure.exposure_s = s.exposure_s;
  exposure.frame = static_cast<std::uint64_t>(number);
  const auto counted = [this](double at_s) { return mount_->angles_at(at_s); };
  if (lens_) exposure.zoom = lens_->unit.zoom_at(monotonic_s(mid_s));
  exposed_.expose(counted, monotonic_s(mid_s), exposure);
  if (s.errors.frames.on && lost) {
    record_.frames_lost += 1;
    return;
  }
  camera::Frame frame;
  frame.mid_exposure_s = stamp_s;
  frame.stamp_sd_s = kStampSd_s;
  frame.number = exposure.frame;
  const ViewTruth view =
      renderer_ ? renderer_->draw(exposure, frame.gray) : view_truth(world_, index_, exposure);
  views_.add(stamp_s, view);
  operator_.see({stamp_s, exposure, view});
  station_.on_frame(frame);
  if (designated() || left_alone()) take_note(mid_s, view);
}

void LockstepStation::detect(double time_s) {
  if (!detection_) return;
  if (detection_->found && time_s >= detection_->ready_s) {
    station_.on_found(*std::exchange(detection_->found, std::nullopt));
  }
  if (const auto picture = station_.picture_to_search(monotonic_s(time_s))) {
    detection_->found = detection_->detector.look(*picture);
    detection_->ready_s = time_s + kDetection_s;
  }
}

void LockstepStation::take_note(double mid_s, const ViewTruth& view) {
  const CameraIntrinsics& camera = config_.geometry.camera;
  const station::StationSnapshot snapshot = station_.snapshot();
  FrameNote note{mid_s,        snapshot.state, snapshot.belief, view, inside_third(camera, view),
                 std::nullopt, snapshot.box,   snapshot.alarms};
  if (snapshot.state == station::StationState::kTracking && snapshot.target_offset_px) {
    note.error_px =
        *snapshot.target_offset_px + Eigen::Vector2d(camera.cx_px, camera.cy_px) - view.centre_px;
  }
  record_.frames.push_back(note);
}

void LockstepStation::operate(double time_s) {
  station_.set_reference(mount_->reference());
  const auto limits = mount_->limits();
  if (!limits) return;
  if (designated()) return;
  station_.set_limits(*limits);
  operator_.act(time_s);
}

StationRecord LockstepStation::record() const {
  StationRecord record = record_;
  record.counters = station_.snapshot().counters;
  record.counters.merge(mount_->counters());
  return record;
}

station::Refusal LockstepStation::slew(station::SlewCommand command, double time_s) {
  command.received_s = monotonic_s(time_s);
  return station_.slew(command, command.received_s);
}

station::Refusal LockstepStation::occlude(station::OcclusionCommand command, double time_s) {
  command.received_s = monotonic_s(time_s);
  return station_.occlude(command, command.received_s);
}

}  // namespace ols::sim
