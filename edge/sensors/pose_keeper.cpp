#include "edge/sensors/pose_keeper.h"

#include "edge/sensors/kept_position.h"
#include "edge/sensors/kept_tilt.h"

namespace ols {

struct PoseKeeper::Impl {
  KeptPosition position;
  KeptTilt tilt;
};

PoseKeeper::PoseKeeper(const Config& config)
    : impl_(std::make_unique<Impl>(Impl{KeptPosition(config), KeptTilt(config)})) {}

PoseKeeper::~PoseKeeper() = default;

void PoseKeeper::add(const GnssReading& reading) { impl_->position.add(reading); }

void PoseKeeper::add(const TiltReading& reading) { impl_->tilt.add(reading); }

StationPose PoseKeeper::pose(double now_s) const {
  StationPose pose;
  impl_->position.fill(pose, now_s);
  impl_->tilt.fill(pose, now_s);
  return pose;
}

std::vector<std::string> PoseKeeper::alarms(double now_s) const {
  std::vector<std::string> alarms;
  impl_->position.add_alarms(alarms, now_s);
  impl_->tilt.add_alarms(alarms, now_s);
  return alarms;
}

}  // namespace ols
