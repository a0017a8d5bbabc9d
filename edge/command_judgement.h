// Why a command must not be carried out as things stand. Pure; nothing is changed by being judged.
#pragma once

#include "edge/pointing_model.h"
#include "edge/station_config.h"
#include "edge/station_mode.h"
#include "edge/station_types.h"

namespace ols::station {

struct Situation {
  const StationConfig& config;
  const StationMode& mode;
  const PointingModel& pointing;
  double now_s = 0.0;  // station's monotonic clock
};

// kNone: it may be carried out, a designation as soon as its frame and the tracker agree.
Refusal judge(const DesignateCommand& command, const Situation& situation);
Refusal judge(const SlewCommand& command, const Situation& situation);
Refusal judge(const PointCommand& command, const Situation& situation);
Refusal judge_home(const Situation& situation);
Refusal judge_reference_ok(const Situation& situation);
Refusal judge_rearm(const Situation& situation);  // by a hand at the station
Refusal judge_rearm_over_bus(const Situation& situation);

}  // namespace ols::station
