#include "edge/sensors/station_position.h"

#include <cmath>

#include "conditions/alarms.h"
#include "edge/sensors/alarm_format.h"

namespace ols::sensors {

namespace {

using Eigen::Vector3d;

bool is_usable(const GnssReading& r) {
  // An antenna on the Earth and plausible sds; comparisons with NaN are false.
  const bool on_earth = std::abs(r.antenna.latitude_rad) <= 1.5708 &&
                        std::abs(r.antenna.longitude_rad) <= 7.0 &&
                        std::abs(r.antenna.height_m) < 1e5;
  const bool sd_finite = r.sd_enu_m.allFinite() && (r.sd_enu_m.array() >= 0.0).all() &&
                         (r.sd_enu_m.array() < 1e6).all();
  return on_earth && sd_finite;
}

}  // namespace

StationPosition::StationPosition(const PoseEstimator::Config& config) : config_(config) {
  ConstantEstimator<3>::Config standing;
  standing.gate_sigma = config.alarm_sigma;
  standing.memory_s = config.gnss_memory_s;
  standing.accept_move_s = config.accept_move_s;
  if (!config.surveyed_position) {
    place_.emplace(standing, std::nullopt);
    return;
  }
  frame_.emplace(*config.surveyed_position);
  place_.emplace(standing,
                 ConstantEstimator<3>::Estimate{config.ground_to_antenna_enu_m,
                                                Vector3d::Constant(config.surveyed_position_sd_m)});
}

void StationPosition::resume(const PersistedPose::Position& known, double now_s, double age_s) {
  if (config_.surveyed_position || age_s > config_.resume_s) return;
  frame_.emplace(known.ground);
  const double grown_m2 = std::pow(config_.growth_m_sqrt_s, 2) * age_s;
  place_->resume(now_s, {config_.ground_to_antenna_enu_m,
                         (known.sd_enu_m.cwiseAbs2().array() + grown_m2).sqrt()});
  known_s_ = now_s - age_s;
}

bool StationPosition::is_from_sensor() const {
  return !config_.surveyed_position && place_->estimate() && !place_->resumed();
}

void StationPosition::add(const GnssReading& reading) {
  if (!std::isfinite(reading.time_s) || (last_ && reading.time_s < last_->time_s)) return;
  const bool used = reading.fix >= config_.least_fix && is_usable(reading);
  last_ = reading;
  if (!used) {
    last_->fix = GnssFix::kNone;
    return;
  }
  if (!frame_) frame_.emplace(reading.antenna);
  place_->add(reading.time_s, frame_->to_enu(ecef_from_geodetic(reading.antenna)),
              reading.sd_enu_m.cwiseMax(config_.gnss_sd_floor_m));
}

bool StationPosition::is_inconsistent(double now_s) const {
  const auto since_s = place_->disagrees_since_s();
  return since_s && now_s - *since_s >= config_.alarm_after_s;
}

bool StationPosition::is_lost(double now_s) const {
  if (place_->resumed()) return true;
  if (!last_) return false;
  const auto until_s = place_->supported_until_s();
  const bool stale = until_s && now_s - *until_s > config_.gnss_stale_s;
  return stale || is_inconsistent(now_s) || last_->fix < config_.least_fix;
}

void StationPosition::fill(StationPose& pose, double now_s) const {
  const auto kept = place_->estimate();
  if (!kept) return;
  if (config_.surveyed_position) {
    pose.position = *config_.surveyed_position;
    pose.position_source = PoseSource::kSurveyed;
  } else {
    pose.position =
        geodetic_from_ecef(frame_->to_ecef(kept->value - config_.ground_to_antenna_enu_m));
    pose.position_source = PoseSource::kSensor;
  }
  double grown_m2 = 0.0;
  const auto until_s = place_->supported_until_s();
  if (until_s && is_lost(now_s)) {
    grown_m2 = std::pow(config_.growth_m_sqrt_s, 2) * std::max(0.0, now_s - *until_s);
  }
  pose.position_sd_enu_m = (kept->sd.cwiseAbs2().array() + grown_m2).sqrt();
}

Alarm StationPosition::disagreement(double now_s) const {
  const std::string distance = format_length(place_->distance().norm());
  const bool surveyed = config_.surveyed_position.has_value();
  const double lasts_s = now_s - *place_->disagrees_since_s();
  if (lasts_s < config_.restation_s) {
    return surveyed ? alarm::gnss_off_survey(distance) : alarm::gnss_off_kept(distance);
  }
  const std::string time = format_time(lasts_s);
  return surveyed ? alarm::gnss_off_survey_long(distance, time)
                  : alarm::gnss_off_kept_long(distance, time);
}

void StationPosition::add_alarms(std::vector<Alarm>& alarms, double now_s) const {
  if (const auto moved_m = place_->moved()) {
    alarms.push_back(alarm::position_adopted(format_length(*moved_m)));
  }
  if (place_->resumed()) {
    alarms.push_back(alarm::position_restored(format_time(now_s - known_s_)));
  }
  if (!last_) return;
  const bool kept = place_->estimate().has_value();
  const char* consequence = kept ? "position kept" : "no position yet";
  const auto until_s = place_->supported_until_s();
  if (now_s - last_->time_s > config_.gnss_stale_s) {
    alarms.push_back(alarm::gnss_silent(format_time(now_s - last_->time_s), consequence));
  } else if (last_->fix < config_.least_fix) {
    alarms.push_back(until_s ? alarm::gnss_lost_fix(format_time(now_s - *until_s), consequence)
                             : alarm::gnss_no_fix(consequence));
  } else if (kept && is_inconsistent(now_s)) {
    alarms.push_back(disagreement(now_s));
  }
}

}  // namespace ols::sensors
