// The servo: makes the PTU follow a moving goal smoothly, and stop when commands stop. Pure.
//
// A D46 in velocity mode would continue to move if its host failed, so it is commanded by
// *positions* only. In every cycle, the command is the position of the goal a short look-ahead in
// the future, with the speed that reaches it in time. While commands arrive, the unit never reaches
// the commanded position and therefore moves smoothly. When they stop, it brakes and stops after at
// most the look-ahead (or 1/gain, if longer) plus its braking time. If the unit is to rest at the
// goal, the goal itself is commanded as soon as it is within reach, and the unit brakes on its own
// ramp.
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
  double min_speed_rad_s = 0.0;  // minimum speed of the unit (PL, TL); set by the driver
  double max_acceleration_rad_s2 = 1.0;
  double goal_timeout_s = 0.5;  // an older goal is stale, and the unit halts
};

// Position and speed to command, for each axis.
struct ServoCommand {
  PanTilt position;  // [rad]
  PanTilt speed;     // [rad/s] magnitude
};

// Computes the command of one cycle from the goal and the present angles and rates. nullopt means
// halt (no goal, stale goal, contradictory limits). For a goal of rates alone, the motion ends at
// the limits and at the borders of keep-out regions. A goal behind a keep-out region is approached
// around it, corner by corner. A goal inside a region is approached up to the border.
std::optional<ServoCommand> servo_step(const ServoConfig& config, const mount::Limits& limits,
                                       const std::optional<mount::Goal>& goal, const PanTilt& now,
                                       double time_s, const PanTilt& now_rate = {});

// The longest time for which the unit keeps moving if its host fails at this speed.
double runs_on_s(const ServoConfig& config, double speed_rad_s);

// The largest allowed runs_on_s(), at kRunsOnSpeed_rad_s or, if lower, at the maximum speed.
constexpr double kRunsOnAtMost_s = 1.0;
constexpr double kRunsOnSpeed_rad_s = 0.349066;  // 20 deg/s
bool runs_on_too_long(const ServoConfig& config);
// The configured maximum speed or, if the unit would run on for too long, a lower speed; 0 if there
// is no such speed.
double max_safe_speed_rad_s(const ServoConfig& config);

}  // namespace ols::ptu
