// The station's pose, from its survey and its sensors. After a restart, the persisted pose
// (pose_store.h) is used until the sensors report.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "conditions/alarm.h"
#include "edge/config/config.h"
#include "edge/process/device_set.h"
#include "edge/process/pose_store.h"
#include "edge/sensors/pose_estimator.h"

namespace ols::station {

class KeptPose {
 public:
  // Restores the parts of the persisted pose whose sensors are still configured.
  KeptPose(const StationSettings& settings, double now_s);

  sensors::StationPose pose(double now_s) const { return estimator_.pose(now_s); }
  // Call in every cycle of the control loop. Passes the devices' readings to the estimator, and
  // persists the pose at intervals, without waiting for the disk. Returns the pose ten times a
  // second, otherwise nullopt.
  std::optional<sensors::StationPose> look(DeviceSet& devices, double now_s);
  std::vector<Alarm> alarms(double now_s) const;

 private:
  sensors::PoseEstimator estimator_;
  PoseStore store_;
  double due_s_ = 0.0;
  double kept_due_s_ = 0.0;
};

}  // namespace ols::station
