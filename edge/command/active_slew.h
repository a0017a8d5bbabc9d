// Keeps the newest slew of this station until the slew's lease ends. Pure.
#pragma once

#include <optional>

#include "edge/command/slew_conflict_monitor.h"
#include "edge/frames/pointing_model.h"
#include "edge/mount/goal.h"
#include "edge/station/station_types.h"

namespace ols::station {

class ActiveSlew {
 public:
  void give(const SlewCommand& command, double now_s);
  void clear() { command_.reset(); }
  void expire(double now_s);

  // nullopt if no slew is active.
  const std::optional<SlewCommand>& command() const { return command_; }
  // Whether the slew is a search along a line. Such a search continues even after the station has
  // found an object; the mount only pauses while the object is on trial.
  bool searches_line() const { return command_ && command_->searches_line(); }
  // The goal of the mount. nullopt if no slew is active, or if the unit cannot point there.
  std::optional<mount::Goal> goal(const PointingModel& pointing, double now_s) const;
  // Whether more than one fusion slews this station.
  bool has_several_senders(double now_s) const { return senders_.are_several(now_s); }

 private:
  bool is_over(double now_s) const { return now_s > command_->received_s + command_->lease_s; }

  std::optional<SlewCommand> command_;
  SlewConflictMonitor senders_;
};

}  // namespace ols::station
