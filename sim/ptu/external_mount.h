// A mount that another program simulates: that program states the angles, and the simulated camera
// on it draws what is seen there.
#pragma once

#include <deque>
#include <mutex>

#include "sim/ptu/device.h"

namespace ols::sim {

class ExternalMount : public PtuDevice {
 public:
  // The angles at an instant of CLOCK_MONOTONIC [s]. One that is not after the newest is ignored.
  void state(double monotonic_s, const PanTilt& angles);

  void set_faults(const PtuFaults& /*faults*/) override {}
  // A straight line between two statements. The first and the last one hold before and after them;
  // zero if there was none.
  PanTilt angles_at(double monotonic_s) override;

 private:
  struct Stated {
    double at_s;
    PanTilt angles;
  };
  std::mutex mutex_;
  std::deque<Stated> stated_;
};

}  // namespace ols::sim
