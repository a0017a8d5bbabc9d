// Keeps the sensors' pose in a file, so that a station restarted while the receiver has no fix
// still knows where it is.
#pragma once

#include <string>

#include "base/background_file.h"
#include "edge/sensors/persisted_pose.h"

namespace ols::station {

class PoseStore {
 public:
  // Reads `file`; empty: nothing is kept. What cannot be read, or is damaged, is a trouble.
  explicit PoseStore(const std::string& file);

  // What was there at the start.
  const sensors::PersistedPose& found() const { return found_; }
  // Written soon: does not wait for the disk. A part that is missing stays as it was found.
  void keep(sensors::PersistedPose pose);
  // In words; empty when all is well.
  std::string trouble() const;

 private:
  sensors::PersistedPose found_;
  std::string refused_;  // why, until another is kept
  BackgroundFile file_;
};

}  // namespace ols::station
