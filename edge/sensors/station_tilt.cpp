#include "edge/sensors/station_tilt.h"

#include <cmath>

#include "conditions/alarms.h"
#include "edge/sensors/alarm_format.h"
#include "geometry/angles.h"

namespace ols::sensors {

namespace {

using Eigen::Vector2d;

ConstantEstimator<2>::Config standing(const PoseEstimator::Config& config) {
  ConstantEstimator<2>::Config c;
  c.gate_sigma = config.alarm_sigma;
  c.memory_s = config.inclinometer_memory_s;
  c.settle_readings = 5;
  return c;
}

std::optional<ConstantEstimator<2>::Estimate> survey(const PoseEstimator::Config& config) {
  if (!config.surveyed_tilt_rad) return std::nullopt;
  return ConstantEstimator<2>::Estimate{*config.surveyed_tilt_rad,
                                        Vector2d::Constant(config.surveyed_tilt_sd_rad)};
}

bool is_usable(const TiltReading& r) {
  return std::isfinite(r.time_s) && std::abs(r.tilt_x_rad) < 1.6 && std::abs(r.tilt_y_rad) < 1.6;
}

}  // namespace

StationTilt::StationTilt(const PoseEstimator::Config& config)
    : config_(config), tilt_(standing(config), survey(config)) {}

void StationTilt::resume(const PersistedPose::Tilt& known, double now_s, double age_s) {
  if (config_.surveyed_tilt_rad || age_s > config_.resume_s) return;
  const double sd_rad =
      std::sqrt(known.sd_rad * known.sd_rad + std::pow(config_.growth_rad_sqrt_s, 2) * age_s);
  tilt_.resume(now_s, {known.tilt_rad, Vector2d::Constant(sd_rad)});
  known_s_ = now_s - age_s;
}

bool StationTilt::is_from_sensor() const {
  return !config_.surveyed_tilt_rad && tilt_.estimate() && !tilt_.resumed();
}

void StationTilt::add(const TiltReading& reading) {
  if (!is_usable(reading) || (last_ && reading.time_s < last_->time_s)) return;
  const bool changed =
      !last_ || reading.tilt_x_rad != last_->tilt_x_rad || reading.tilt_y_rad != last_->tilt_y_rad;
  if (changed) changed_s_ = reading.time_s;
  last_ = reading;
  if (is_stuck(reading.time_s)) return;
  tilt_.add(reading.time_s, {reading.tilt_x_rad, reading.tilt_y_rad},
            Vector2d::Constant(config_.inclinometer_sd_rad));
}

bool StationTilt::is_stuck(double time_s) const {
  return last_ && time_s - changed_s_ >= config_.stuck_s;
}

bool StationTilt::is_inconsistent(double now_s) const {
  const auto since_s = tilt_.disagrees_since_s();
  return since_s && now_s - *since_s >= config_.alarm_after_s;
}

bool StationTilt::is_lost(double now_s) const {
  if (tilt_.resumed()) return true;
  const auto until_s = tilt_.supported_until_s();
  const bool stale = until_s && now_s - *until_s > config_.inclinometer_stale_s;
  return last_ && (stale || is_inconsistent(now_s) || is_stuck(last_->time_s));
}

void StationTilt::fill(StationPose& pose, double now_s) const {
  const auto kept = tilt_.estimate();
  if (!kept) {
    pose.tilt_sd_rad = config_.level_sd_rad;
    return;
  }
  pose.tilt_source = config_.surveyed_tilt_rad ? PoseSource::kSurveyed : PoseSource::kSensor;
  pose.tilt_x_rad = kept->value.x();
  pose.tilt_y_rad = kept->value.y();
  double grown_rad2 = 0.0;
  const auto until_s = tilt_.supported_until_s();
  if (until_s && is_lost(now_s)) {
    grown_rad2 = std::pow(config_.growth_rad_sqrt_s, 2) * std::max(0.0, now_s - *until_s);
  }
  pose.tilt_sd_rad = std::sqrt(kept->sd.cwiseAbs2().maxCoeff() + grown_rad2);
}

void StationTilt::add_alarms(std::vector<Alarm>& alarms, double now_s) const {
  if (tilt_.resumed()) {
    alarms.push_back(alarm::tilt_restored(format_time(now_s - known_s_)));
  } else if (const auto moved_rad = tilt_.moved()) {
    alarms.push_back(alarm::tilt_adopted(format_angle(*moved_rad)));
  }
  if (!last_) return;
  const char* consequence = tilt_.estimate() ? "tilt kept" : "no tilt yet";
  if (now_s - last_->time_s > config_.inclinometer_stale_s) {
    alarms.push_back(alarm::inclinometer_silent(format_time(now_s - last_->time_s), consequence));
  } else if (is_stuck(last_->time_s)) {
    alarms.push_back(alarm::inclinometer_stuck(format_time(now_s - changed_s_), consequence));
  } else if (is_inconsistent(now_s)) {
    const std::string angle = format_angle(tilt_.distance().norm());
    const bool surveyed = config_.surveyed_tilt_rad.has_value();
    const double lasts_s = now_s - *tilt_.disagrees_since_s();
    if (lasts_s < config_.restation_s) {
      alarms.push_back(surveyed ? alarm::tilt_off_survey(angle) : alarm::tilt_off_kept(angle));
    } else {
      const std::string time = format_time(lasts_s);
      alarms.push_back(surveyed ? alarm::tilt_off_survey_long(angle, time)
                                : alarm::tilt_off_kept_long(angle, time));
    }
  }
}

}  // namespace ols::sensors
