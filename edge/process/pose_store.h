// Persists the station's pose, as its sensors have measured it, in a file. So a station that
// restarts while its receiver has no fix still has a position.
#pragma once

#include <string>

#include "base/files/background_file.h"
#include "conditions/alarm.h"
#include "edge/sensors/persisted_pose.h"

namespace ols::station {

class PoseStore {
 public:
  // Reads `file`; if it is empty, nothing is persisted. trouble() reports a file that is damaged or
  // cannot be read.
  explicit PoseStore(const std::string& file);

  // The pose that was found at the start.
  const sensors::PersistedPose& found() const { return found_; }
  // Writes the pose soon, without waiting for the disk. Parts that are missing keep their persisted
  // value.
  void keep(sensors::PersistedPose pose);
  // Empty if there is no trouble.
  Alarm trouble() const;

 private:
  sensors::PersistedPose found_;
  Alarm refused_;  // cleared when a pose has been saved
  BackgroundFile file_;
};

}  // namespace ols::station
