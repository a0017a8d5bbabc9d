// The servo: makes a PTU follow a moving goal smoothly, and stop when the commands cease. Pure.
//
// In velocity mode, a unit such as the D46 would continue to move if the station's computer failed.
// The servo therefore commands only *positions*. In every cycle, the commanded position is
// ahead of the goal: by the goal's travel during the look-ahead, plus the unit's braking distance
// from the goal's rate. The unit does not reach this position while commands arrive, and therefore
// moves smoothly. When the commands cease, the unit stops after at most the look-ahead (or 1/gain,
// if longer) plus its braking time. If the unit must come to rest at the goal, the goal itself is
// commanded as soon as it is within reach, and the unit brakes with its own acceleration.
#pragma once

#include <optional>

#include "edge/mount/goal.h"
#include "edge/mount/limits.h"
#include "geometry/kinematic_chain.h"

namespace ols::ptu {

struct ServoConfig {
  double gain_hz = 3.0;          // proportional gain on the position error
  double look_ahead_s = 0.3;     // time by which the commanded position is ahead of the goal
  double max_speed_rad_s = 1.0;  // about 57 deg/s
  double min_speed_rad_s = 0.0;  // minimum speed of the unit (PL, TL); set by the driver
  double max_acceleration_rad_s2 = 1.0;
  double goal_timeout_s = 0.5;  // the unit halts if the goal is older
};

// Position and speed to command.
struct ServoCommand {
  PanTilt position;  // [rad]
  PanTilt speed;     // [rad/s] magnitude
};

// Computes the command of one cycle from the goal and the present angles and rates. nullopt means
// halt: there is no goal, the goal is too old or not finite, the limits contradict each other, or
// the unit is inside a keep-out region and has no way out. If the goal is only a rate, the motion
// ends at the limits and at the borders of keep-out regions; from inside a region, a rate is not
// obeyed. A goal behind a keep-out region is approached around it, corner by corner. A goal inside
// a region is approached as far as the border.
std::optional<ServoCommand> servo_step(const ServoConfig& config, const mount::Limits& limits,
                                       const std::optional<mount::Goal>& goal, const PanTilt& now,
                                       double time_s, const PanTilt& now_rate = {});

// The longest time for which the unit continues to move if the computer fails while the unit has
// this speed.
double runs_on_s(const ServoConfig& config, double speed_rad_s);

// The largest permitted runs_on_s(). It is checked at kRunsOnSpeed_rad_s or, if lower, at the
// maximum speed.
constexpr double kRunsOnAtMost_s = 1.0;
constexpr double kRunsOnSpeed_rad_s = 0.349066;  // 20 deg/s
bool runs_on_too_long(const ServoConfig& config);
// The configured maximum speed or, if the unit would run on for too long, the largest permitted
// speed; 0 if no speed is permitted.
double max_safe_speed_rad_s(const ServoConfig& config);

}  // namespace ols::ptu
