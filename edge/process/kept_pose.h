// The station's pose from survey and sensors. After a restart it is the persisted pose
// (pose_store.h) until the sensors report.
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
  // Restores the persisted pose, but only for sensors that the station still has.
  KeptPose(const StationSettings& settings, double now_s);

  sensors::StationPose pose(double now_s) const { return estimator_.pose(now_s); }
  // Call in every turn. Returns the pose if one is due. Does not wait for the disk.
  std::optional<sensors::StationPose> look(DeviceSet& devices, double now_s);
  std::vector<Alarm> alarms(double now_s) const;

 private:
  sensors::PoseEstimator estimator_;
  PoseStore store_;
  double due_s_ = 0.0;
  double kept_due_s_ = 0.0;
};

}  // namespace ols::station
