// A fixed mount with the interface of a PTU: the camera's angles never change.
#pragma once

#include "sim/ptu/device.h"

namespace ols::sim {

class FixedCamera : public PtuDevice {
 public:
  explicit FixedCamera(const PanTilt& angles) : angles_(angles) {}

  void set_faults(const PtuFaults& /*faults*/) override {}
  PanTilt angles_at(double /*monotonic_s*/) override { return angles_; }

 private:
  const PanTilt angles_;
};

}  // namespace ols::sim
