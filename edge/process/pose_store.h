// Persists the sensors' pose in a file, so that a station has a position even if it restarts while
// the receiver has no fix.
#pragma once

#include <string>

#include "base/files/background_file.h"
#include "conditions/alarm.h"
#include "edge/sensors/persisted_pose.h"

namespace ols::station {

class PoseStore {
 public:
  // Reads `file`; empty: nothing is persisted. trouble() reports a file that is damaged or cannot
  // be read.
  explicit PoseStore(const std::string& file);

  // The pose found at the start.
  const sensors::PersistedPose& found() const { return found_; }
  // Writes soon, without waiting for the disk. A missing part keeps its persisted value.
  void keep(sensors::PersistedPose pose);
  // Empty: no trouble.
  Alarm trouble() const;

 private:
  sensors::PersistedPose found_;
  Alarm refused_;  // cleared when a pose is saved
  BackgroundFile file_;
};

}  // namespace ols::station
