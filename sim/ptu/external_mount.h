// A mount that another program simulates: that program states the angles, and the simulated camera
// on it draws what is seen there.
#pragma once

#include <mutex>

#include "edge/mount/angle_history.h"
#include "sim/ptu/device.h"

namespace ols::sim {

class ExternalMount : public PtuDevice {
 public:
  ExternalMount();

  // The angles at an instant of CLOCK_MONOTONIC [s]. One that is not after the newest is ignored.
  void state(double monotonic_s, const PanTilt& angles);

  void set_faults(const PtuFaults& /*faults*/) override {}
  // Linear between two statements. Elsewhere the newest one holds; zero if there was none.
  PanTilt angles_at(double monotonic_s) override;

 private:
  std::mutex mutex_;
  mount::AngleHistory history_;
};

}  // namespace ols::sim
