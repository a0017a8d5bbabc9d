// The master of a simulated PTU, in simulated time.
#pragma once

#include <string>

#include "geometry/angles.h"
#include "sim/ptu/faults.h"

namespace ols::sim {

inline PtuUnitConfig ready_unit() {
  PtuUnitConfig config;
  config.home_at_power_up = false;
  config.echo = false;
  config.verbose = false;
  return config;
}

class Master {
 public:
  explicit Master(const PtuUnitConfig& config) : unit(config, 1, 0.0) { first = wait(0.5); }

  // Sends a request; returns everything that the unit sends within `duration_s`.
  std::string ask(const std::string& request, double duration_s = 0.5) {
    unit.receive(request, time_s);
    return wait(duration_s);
  }
  std::string wait(double duration_s) {
    std::string said;
    for (const double end_s = time_s + duration_s; time_s < end_s; time_s += 1e-3) {
      said += unit.transmit(time_s);
    }
    return said;
  }
  void set(const PtuFaults& faults) { unit.set_faults(faults, time_s); }
  // The true position of the mechanism.
  double pan_counts() const { return unit.angles_at(time_s).pan_rad / radians(11.5714 / 3600.0); }
  double tilt_counts() const { return unit.angles_at(time_s).tilt_rad / radians(11.5714 / 3600.0); }

  FaultyPtuUnit unit;
  double time_s = 0.0;
  std::string first;  // the unit's output at power-up
};

}  // namespace ols::sim
