// Keeps the motion that an operator commands: either angles that the unit must reach, or rates that
// are valid for their lease. Pure.
#pragma once

#include <optional>

#include "edge/mount/goal.h"
#include "edge/station/station_types.h"

namespace ols::station {

class ManualMotion {
 public:
  void point(const PanTilt& angles, double now_s, double until_s);
  void turn(const RateCommand& command);
  void clear();

  // Whether this rate arrives too late: a rate that the same sender has sent after it is already in
  // force.
  bool overtakes(const RateCommand& command, double now_s) const;

  // nullopt means halt. A unit at speed v with deceleration a needs the time v/a to come to rest.
  // Therefore, it is halted before the lease ends, after the share kInForce of the lease.
  std::optional<mount::Goal> goal(double now_s) const;

  static constexpr double kInForce = 0.8;

 private:
  static double ends_s(const RateCommand& rate) {
    return rate.received_s + kInForce * rate.lease_s;
  }

  std::optional<mount::Goal> point_;
  std::optional<RateCommand> rate_;
};

}  // namespace ols::station
