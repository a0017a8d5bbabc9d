// The motion that the operator commands: angles at which the unit is to stand, or rates while their
// lease lasts. Pure.
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

  // Whether a later rate of the same sender is already in force, because this one was overtaken on
  // its way.
  bool overtakes(const RateCommand& command, double now_s) const;

  // nullopt: halt. A halted unit still moves for v/a while it brakes. The halt therefore comes
  // early, after the share kInForce of the lease.
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
