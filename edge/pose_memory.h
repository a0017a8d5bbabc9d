// Keeps the sensors' pose in a file, so that a station restarted while the receiver has no fix
// still knows where it is. A thread writes: a disk that hangs must not hold the control loop.
#pragma once

#include <memory>
#include <string>

#include "edge/sensors/remembered_pose.h"

namespace ols {

class PoseMemory {
 public:
  // Reads `file`; empty: nothing is kept. What cannot be read, or is damaged, is a trouble.
  explicit PoseMemory(const std::string& file);
  ~PoseMemory();  // does not wait for a disk that hangs
  PoseMemory(const PoseMemory&) = delete;
  PoseMemory& operator=(const PoseMemory&) = delete;

  // What was there at the start.
  const RememberedPose& found() const { return found_; }
  // To be written soon, in place of what still waits. A part that is missing stays as it was found.
  void keep(RememberedPose pose);
  // In words; empty when all is well.
  std::string trouble() const;

 private:
  struct Shared;  // with the thread

  RememberedPose found_;
  std::shared_ptr<Shared> shared_;
};

}  // namespace ols
