// What the fusion last predicted of a target that the land hides, while it holds. Pure.
#pragma once

#include <optional>

#include "edge/frames/pointing_model.h"
#include "edge/mount/goal.h"
#include "edge/station/station_types.h"

namespace ols::station {

class ActiveOcclusion {
 public:
  // False if a later one of the same sender is in force.
  bool give(const OcclusionCommand& command);
  void clear() { command_.reset(); }
  void expire(double now_s);

  // nullopt: nothing is predicted.
  const std::optional<OcclusionCommand>& command() const { return command_; }
  // Where the target comes out, as a slew; nullopt: not known.
  std::optional<SlewCommand> exit() const;
  // The mount waits there. nullopt: the place is not known, or the unit cannot point there.
  std::optional<mount::Goal> goal(const PointingModel& pointing, double now_s) const;

 private:
  std::optional<OcclusionCommand> command_;
};

}  // namespace ols::station
