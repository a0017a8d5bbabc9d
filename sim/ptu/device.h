// The PTU under a simulated station's camera: the simulated unit, or a real one on its line.
#pragma once

#include "geometry/kinematic_chain.h"
#include "sim/scenario/faults.h"

namespace ols::sim {

class PtuDevice {
 public:
  virtual ~PtuDevice() = default;

  // From any thread.
  virtual void set_faults(const PtuFaults& faults) = 0;

  // Waits briefly until the angles at that instant of CLOCK_MONOTONIC [s] are final.
  virtual void await(double /*monotonic_s*/) {}

  // Shaft angles at an instant of CLOCK_MONOTONIC [s], from two seconds ago to now. From any
  // thread.
  virtual PanTilt angles_at(double monotonic_s) = 0;
};

}  // namespace ols::sim
