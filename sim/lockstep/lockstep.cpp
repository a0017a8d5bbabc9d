#include "sim/lockstep/lockstep.h"

#include <algorithm>
#include <cmath>

#include "geometry/lens.h"
#include "sim/world/land_model.h"

namespace ols::sim {
namespace {

constexpr double kTick_s = 1e-3;
constexpr std::int64_t kStatusTicks = 500;
constexpr std::uint64_t kBearingTag = 8000, kSlewTag = 9000, kOcclusionTag = 9500;

std::int64_t utime_us(double time_s) {
  return Lockstep::kStartUtime_us + std::llround(time_s * 1e6);
}

double time_of(std::int64_t utime_us) {
  return 1e-6 * static_cast<double>(utime_us - Lockstep::kStartUtime_us);
}

fusion::LandUse land_of(const World& world, const Fidelity& fidelity) {
  if (!fidelity.land_model || !world.relief()) return {};
  return {.surface = survey(world.scenario().relief, world.site(), world.seed()).terrain()};
}

}  // namespace

Lockstep::Lockstep(const World& world, const Fidelity& fidelity,
                   const std::vector<std::optional<StationCalibration>>& calibrations)
    : world_(world),
      bearings_(world.scenario().errors.messages, derived_seed(world.seed(), kBearingTag)),
      slews_(world.scenario().errors.messages, derived_seed(world.seed(), kSlewTag)),
      occlusions_(world.scenario().errors.messages, derived_seed(world.seed(), kOcclusionTag)),
      newest_slew_us_(world.stations().size(), 0),
      fusion_({.handover = fidelity.handover, .land = land_of(world, fidelity)}) {
  auto renderers = fidelity.pictures
                       ? make_renderers(world)
                       : std::vector<std::unique_ptr<Renderer>>(world.stations().size());
  for (std::size_t i = 0; i < world.stations().size(); ++i) {
    stations_.push_back(std::make_unique<LockstepStation>(
        world, i, fidelity, std::move(renderers[i]),
        i < calibrations.size() ? calibrations[i] : std::nullopt));
    know_station(i);
  }
}

// A station that sends bearings says with them where it is.
void Lockstep::know_station(std::size_t index) {
  const StationTruth& station = world_.stations()[index];
  const auto snapshot = stations_[index]->station().snapshot();
  const bool waits = snapshot.state == station::StationState::kIdle ||
                     snapshot.state == station::StationState::kSlewed;
  if (tick_ > 0 && !waits) return;
  fusion_.know_station(station.id,
                       {.camera_ecef = camera_centre_ecef(station.nominal, {}),
                        .field_of_view_rad = field_of_view(station.nominal.camera).minCoeff(),
                        .axis = snapshot.optical_axis,
                        .commandable = !world_.scenario().stations[index].overview &&
                                       !world_.scenario().stations[index].fixed});
}

void Lockstep::run(double duration_s) {
  const auto ticks = static_cast<std::int64_t>(std::llround(duration_s / kTick_s));
  for (; tick_ < ticks; ++tick_) advance(static_cast<double>(tick_) * kTick_s);
}

void Lockstep::advance(double time_s) {
  for (const AddressedSlew& slew : slews_.receive(time_s)) deliver(slew, time_s);
  for (const fusion::OcclusionNotice& notice : occlusions_.receive(time_s)) deliver(notice, time_s);
  if (tick_ > 0 && tick_ % kStatusTicks == 0) {
    for (std::size_t i = 0; i < stations_.size(); ++i) know_station(i);
  }
  bool all_designated = true;
  for (std::size_t i = 0; i < stations_.size(); ++i) {
    for (const station::Bearing& bearing : stations_[i]->advance(time_s)) send(i, bearing, time_s);
    all_designated = all_designated && (stations_[i]->designated() || stations_[i]->left_alone());
  }
  if (all_designated && result_.designated_s < 0.0) result_.designated_s = time_s;
  for (const fusion::BearingMeasurement& measurement : bearings_.receive(time_s))
    fuse(measurement, time_s);
}

void Lockstep::send(std::size_t station, const station::Bearing& bearing, double time_s) {
  const StationTruth& truth = world_.stations()[station];
  fusion::BearingMeasurement measurement;
  measurement.station = truth.id;
  // The station's clock is off; its times of frame and angles are consistent with each other.
  const double exposed_s = bearing.mid_exposure_s - monotonic_s(0.0);
  measurement.utime_us = utime_us(exposed_s + truth.clock_offset_s);
  measurement.sight = bearing.sight;
  measurement.belief = bearing.belief;
  measurement.clock_sd_s = std::hypot(truth.clock_sd_s, bearing.stamp_sd_s);
  measurement.track_id = bearing.track_id;
  measurement.is_acquired = bearing.acquired;
  measurement.calibration_id = bearing.pose_revision;
  if (bearing.detected) {
    const station::DetectedObject& object = *bearing.detected;
    measurement.is_tracklet = object.is_tracklet;
    measurement.image_bearings = object.image_bearings;
    measurement.sighted = {.rate_rad_s = object.rate_rad_s,
                           .rate_covariance = object.rate_covariance,
                           .size_rad = object.size_rad,
                           .size_sd_rad = object.size_sd_rad,
                           .across_rad = object.across_rad,
                           .size_noise_rad = object.size_noise_rad,
                           .signal = object.signal};
  }
  bearings_.send(measurement, time_s);
  if (bearing.is_tracklet()) return;
  for (station::Sighting& one : stations_[station]->sightings(bearing, measurement.utime_us)) {
    result_.sightings.push_back({station, std::move(one)});
  }
}

void Lockstep::fuse(const fusion::BearingMeasurement& measurement, double time_s) {
  const fusion::FusionOutput output = fusion_.add(measurement);
  if (listener_) {
    for (const fusion::FusedTarget& target : output.targets) listener_(target, time_s);
  }
  if (result_.designated_s >= 0.0) {
    for (const fusion::FusedTarget& target : output.targets) record(target, time_s, result_.joint);
    for (const fusion::FusedTarget& target : output.targets_paper)
      record(target, time_s, result_.paper);
  }
  send(output.slews, time_s);
  for (const fusion::OcclusionNotice& notice : output.occlusions) {
    result_.occlusions.push_back(notice);
    occlusions_.send(notice, time_s);
  }
}

void Lockstep::hear(const fusion::Cue& cue, double time_s) {
  send(fusion_.add(cue, utime_us(time_s)), time_s);
}

void Lockstep::send(const std::vector<fusion::Slew>& slews, double time_s) {
  for (const fusion::Slew& slew : slews) {
    result_.slews.push_back(slew);
    slews_.send({index_of(slew.station), slew}, time_s);
  }
}

void Lockstep::record(const fusion::FusedTarget& target, double time_s,
                      std::vector<Fix>& fixes) const {
  if (target.estimate.solution != fusion::Solution::kOk) return;
  Fix fix;
  fix.utime_us = target.utime_us;
  fix.target_id = target.target_id;
  fix.time_s = time_of(target.utime_us);
  fix.published_s = time_s;
  fix.position = geodetic_from_ecef(target.estimate.position_ecef);
  const Eigen::Matrix3d R_enu_ecef = world_.site().R_ecef_enu().transpose();
  fix.error_enu_m =
      R_enu_ecef * (target.estimate.position_ecef - world_.target(0, fix.time_s).p_ecef);
  fix.covariance_enu_m2 = R_enu_ecef * target.estimate.covariance_ecef * R_enu_ecef.transpose();
  for (const fusion::ContributingStation& station : target.stations) {
    if (station.used) fix.used.push_back(index_of(station.station));
  }
  fixes.push_back(fix);
}

void Lockstep::deliver(const AddressedSlew& addressed, double time_s) {
  const fusion::Slew& slew = addressed.slew;
  std::int64_t& newest_us = newest_slew_us_[addressed.station];
  if (slew.utime_us <= newest_us) return;  // duplicated or overtaken
  newest_us = slew.utime_us;
  station::SlewCommand command;
  const double offset_s = world_.stations()[addressed.station].clock_offset_s;
  command.effect_s = monotonic_s(time_of(slew.effect_utime_us) - offset_s);
  command.lease_s = slew.lease_s;
  command.target_id = slew.target_id;
  command.direction = slew.direction;
  command.azimuth_rate_rad_s = slew.azimuth_rate_rad_s;
  command.elevation_rate_rad_s = slew.elevation_rate_rad_s;
  command.direction_sd_rad = slew.direction_sd_rad;
  command.line = slew.line;
  command.let_go_track_id = slew.let_go_track_id;
  stations_[addressed.station]->slew(command, time_s);
}

void Lockstep::deliver(const fusion::OcclusionNotice& notice, double time_s) {
  const std::size_t index = index_of(notice.station);
  const double offset_s = world_.stations()[index].clock_offset_s;
  station::OcclusionCommand command;
  command.made_s = monotonic_s(time_of(notice.utime_us) - offset_s);
  command.holds_s = notice.holds_s;
  command.target_id = notice.target_id;
  if (notice.exit) {
    command.exit = {command.made_s + notice.exit->in_s, notice.exit->sd_s, notice.exit->direction,
                    std::sqrt(notice.exit->covariance.trace() / 2.0)};
  }
  stations_[index]->occlude(command, time_s);
}

std::size_t Lockstep::index_of(const std::string& station) const {
  const auto& all = world_.stations();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const StationTruth& s) { return s.id == station; });
  return static_cast<std::size_t>(found - all.begin());
}

LockstepResult Lockstep::result() const {
  LockstepResult result = result_;
  const fusion::FusionHealth health = fusion_.health();
  result.alarms = health.alarms;
  result.counters = health.counters;
  for (const auto& station : stations_) result.stations.push_back(station->record());
  return result;
}

}  // namespace ols::sim
