#include "edge/sensors/pose_estimator.h"

#include "edge/sensors/station_position.h"
#include "edge/sensors/station_tilt.h"

namespace ols::sensors {
namespace {

// The age is unknown if the clock was set back since then or is not set yet: some days are assumed.
double age_s(std::int64_t utime_us, std::int64_t now_utime_us) {
  constexpr double kUnknownAge_s = 3 * 86400.0;
  const double age_s = (static_cast<double>(now_utime_us) - static_cast<double>(utime_us)) * 1e-6;
  return age_s >= 0.0 ? age_s : kUnknownAge_s;
}

}  // namespace

struct PoseEstimator::Impl {
  StationPosition position;
  StationTilt tilt;
};

PoseEstimator::PoseEstimator(const Config& config)
    : impl_(std::make_unique<Impl>(Impl{StationPosition(config), StationTilt(config)})) {}

PoseEstimator::~PoseEstimator() = default;

void PoseEstimator::resume(const PersistedPose& known, double now_s, std::int64_t now_utime_us) {
  if (known.position) {
    impl_->position.resume(*known.position, now_s, age_s(known.position->utime_us, now_utime_us));
  }
  if (known.tilt) {
    impl_->tilt.resume(*known.tilt, now_s, age_s(known.tilt->utime_us, now_utime_us));
  }
}

PersistedPose PoseEstimator::to_persist(double now_s, std::int64_t now_utime_us) const {
  const StationPose now = pose(now_s);
  PersistedPose pose;
  if (impl_->position.is_from_sensor()) {
    pose.position = {now.position, now.position_sd_enu_m, now_utime_us};
  }
  if (impl_->tilt.is_from_sensor()) {
    pose.tilt = {{now.tilt_x_rad, now.tilt_y_rad}, now.tilt_sd_rad, now_utime_us};
  }
  return pose;
}

void PoseEstimator::add(const GnssReading& reading) { impl_->position.add(reading); }

void PoseEstimator::add(const TiltReading& reading) { impl_->tilt.add(reading); }

StationPose PoseEstimator::pose(double now_s) const {
  StationPose pose;
  impl_->position.fill(pose, now_s);
  impl_->tilt.fill(pose, now_s);
  return pose;
}

std::vector<Alarm> PoseEstimator::alarms(double now_s) const {
  std::vector<Alarm> alarms;
  impl_->position.add_alarms(alarms, now_s);
  impl_->tilt.add_alarms(alarms, now_s);
  return alarms;
}

}  // namespace ols::sensors
