// Persists the station's pose, as its sensors have measured it, in a file. With this file, a
// station that restarts while its GNSS receiver has no fix still has a position.
#pragma once

#include <string>

#include "base/files/background_file.h"
#include "conditions/alarm.h"
#include "edge/sensors/persisted_pose.h"

namespace ols::station {

class PoseStore {
 public:
  // Reads the persisted pose from `file`. If the name is empty, nothing is persisted. trouble()
  // reports a file that is damaged or cannot be read.
  explicit PoseStore(const std::string& file);

  // The pose that was in the file at the start.
  const sensors::PersistedPose& found() const { return found_; }
  // Passes the pose to a thread that writes it, and returns at once. If `pose` contains no position
  // or no tilt, the one that was in the file at the start is written.
  void keep(sensors::PersistedPose pose);
  // Why the pose was not read or cannot be written; empty if all is well.
  Alarm trouble() const;

 private:
  sensors::PersistedPose found_;
  Alarm refused_;  // why the file was not used; cleared when a pose is written
  BackgroundFile file_;
};

}  // namespace ols::station
