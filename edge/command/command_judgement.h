// Decides whether a command may be carried out in the present situation, and if not, why. Pure.
#pragma once

#include "edge/frames/pointing_model.h"
#include "edge/station/station_config.h"
#include "edge/station/station_mode.h"
#include "edge/station/station_types.h"

namespace ols::station {

struct Situation {
  const StationConfig& config;
  const StationMode& mode;
  const PointingModel& pointing;
  double now_s = 0.0;  // on the station's monotonic clock
};

// These functions return kNone if the command is permitted. The Station checks further conditions:
// for a designation, that it has the frame and the tracker accepts the box; for a point command,
// that the unit can reach the angles.
Refusal judge(const DesignateCommand& command, const Situation& situation);
Refusal judge(const SlewCommand& command, const Situation& situation);
Refusal judge(const OcclusionCommand& command, const Situation& situation);
Refusal judge(const PointCommand& command, const Situation& situation);
Refusal judge(const RateCommand& command, const Situation& situation);
Refusal judge(const LensCommand& command, const Situation& situation);
// For any command by which an operator moves the unit.
Refusal judge_motion(const Situation& situation);
Refusal judge_home(const Situation& situation);
Refusal judge_reference_ok(const Situation& situation);
Refusal judge_rearm(const Situation& situation);  // by a person at the station
Refusal judge_rearm_over_bus(const Situation& situation);

}  // namespace ols::station
