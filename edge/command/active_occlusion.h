// Keeps the fusion's newest prediction about a target that the land hides, as long as the
// prediction is valid. Pure.
#pragma once

#include <optional>

#include "edge/frames/pointing_model.h"
#include "edge/mount/goal.h"
#include "edge/station/station_types.h"

namespace ols::station {

class ActiveOcclusion {
 public:
  // Takes a prediction. Returns false, and ignores it, if a later prediction from the same sender
  // is in force.
  bool give(const OcclusionCommand& command);
  void clear() { command_.reset(); }
  void expire(double now_s);

  // nullopt if nothing is predicted.
  const std::optional<OcclusionCommand>& command() const { return command_; }
  // The place where the target will reappear, as a slew; nullopt if it is unknown.
  std::optional<SlewCommand> exit() const;
  // The goal of the mount: to point at the place where the target will reappear, and to wait.
  // nullopt if the place is unknown, or if the unit cannot point there.
  std::optional<mount::Goal> goal(const PointingModel& pointing, double now_s) const;

 private:
  std::optional<OcclusionCommand> command_;
};

}  // namespace ols::station
