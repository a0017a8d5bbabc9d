// The servo: the PTU follows a moving goal smoothly, and stops when commands stop. Pure.
//
// A D46 in velocity mode continues to move when its host fails, so it is commanded only by
// *positions*: in every cycle the goal a short look-ahead in the future, at the speed that arrives
// there in time. While commands arrive, the unit never reaches the commanded position and moves
// smoothly; when they stop, it brakes and stops after at most the look-ahead (or 1/gain, if longer)
// plus its braking time. For a goal at which the unit is to rest, the goal itself is commanded as
// soon as it is within reach, and the unit brakes on its own ramp.
#pragma once

#include <optional>

#include "edge/mount/goal.h"
#include "edge/mount/limits.h"
#include "geometry/kinematic_chain.h"

namespace ols::ptu {

struct ServoConfig {
  double gain_hz = 3.0;          // proportional gain on the position error
  double look_ahead_s = 0.3;     // the commanded position is this far ahead
  double max_speed_rad_s = 1.0;  // about 57 deg/s
  double min_speed_rad_s = 0.0;  // of the unit (PL, TL); set by the driver
  double max_acceleration_rad_s2 = 1.0;
  double goal_timeout_s = 0.5;  // a goal older than this is stale: halt
};

// Target position and speed of each axis.
struct ServoCommand {
  PanTilt position;  // [rad]
  PanTilt speed;     // [rad/s] magnitudes
};

// The command of one cycle from the goal and the current angles and rates. Nothing: halt (no goal,
// stale goal, contradictory limits). A goal of rates alone ends at the limits and at the regions'
// borders. A goal behind a keep-out region is approached around it, corner by corner; a goal inside
// a region is approached up to its border.
std::optional<ServoCommand> servo_step(const ServoConfig& config, const mount::Limits& limits,
                                       const std::optional<mount::Goal>& goal, const PanTilt& now,
                                       double time_s, const PanTilt& now_rate = {});

// The longest time for which the unit moves on if its host fails while it moves at this speed.
double runs_on_s(const ServoConfig& config, double speed_rad_s);

// The limit of runs_on_s() at kRunsOnSpeed_rad_s, or at the maximum speed if that is lower.
constexpr double kRunsOnAtMost_s = 1.0;
constexpr double kRunsOnSpeed_rad_s = 0.349066;  // 20 deg/s
bool runs_on_too_long(const ServoConfig& config);
// The configured maximum speed, or a lower speed at which the unit does not run on for too long; 0
// if there is no such speed.
double max_safe_speed_rad_s(const ServoConfig& config);

}  // namespace ols::ptu
