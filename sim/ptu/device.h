// The unit that carries a simulated station's camera: a simulated unit, or a real PTU on its serial
// line.
#pragma once

#include "geometry/kinematic_chain.h"
#include "sim/scenario/faults.h"

namespace ols::sim {

class PtuDevice {
 public:
  virtual ~PtuDevice() = default;

  // May be called from any thread.
  virtual void set_faults(const PtuFaults& faults) = 0;

  // Waits until angles_at() for this instant of CLOCK_MONOTONIC [s] will no longer change; gives up
  // after a short time.
  virtual void await(double /*monotonic_s*/) {}

  // Shaft angles at an instant of CLOCK_MONOTONIC [s], from two seconds ago to now. From any
  // thread.
  virtual PanTilt angles_at(double monotonic_s) = 0;
};

}  // namespace ols::sim
