// The servo: makes the PTU follow a moving goal smoothly, and come to rest by itself. Pure.
//
// A D46 in velocity mode runs on when its master dies. Here it is only ever given *positions*:
// every cycle the goal a short look-ahead further on, at the speed that arrives there in time.
// While commands keep coming the unit never reaches the goal and moves smoothly; when they stop it
// brakes and stands, after at most the look-ahead (or 1/gain, if that is longer) plus its braking
// time.
#pragma once

#include <optional>
#include <vector>

#include "edge/ptu/keep_out.h"
#include "geometry/kinematic_chain.h"

namespace ols {

struct ServoConfig {
  double gain_hz = 3.0;          // proportional gain on the position error
  double look_ahead_s = 0.3;     // the commanded position is this far ahead
  double max_speed_rad_s = 1.0;  // about 57 deg/s
  double min_speed_rad_s = 0.0;  // of the unit (PL, TL), the driver fills it in
  double max_acceleration_rad_s2 = 1.0;
  double goal_timeout_s = 0.5;  // a goal older than this is stale: halt
};

// Where to be: angles at an instant and their rates.
struct ServoGoal {
  double time_s = 0.0;  // station's monotonic clock
  PanTilt angles;
  PanTilt rate;                // [rad/s] feed-forward; 0 for a fixed goal
  double valid_until_s = 0.0;  // the servo halts after this
};

// What to send: for each axis a target position and a speed. Nothing to move means halt.
struct ServoCommand {
  PanTilt position;  // [rad]
  PanTilt speed;     // [rad/s] magnitudes
};

struct PtuLimits {  // [rad], as reported by the unit, narrowed by the configuration
  double pan_min_rad = -2.7, pan_max_rad = 2.7;
  double tilt_min_rad = -0.8, tilt_max_rad = 0.5;
  std::vector<KeepOut> keep_out = {};  // never entered, never swept across
};

// One cycle: goal, where the unit is now and how fast it moves, time. Nothing = halt (no goal,
// stale goal, limits without room between them). A goal behind a keep-out is gone to the way round,
// a corner at a time; one within is approached up to the border.
std::optional<ServoCommand> servo_step(const ServoConfig& config, const PtuLimits& limits,
                                       const std::optional<ServoGoal>& goal, const PanTilt& now,
                                       double time_s, const PanTilt& now_rate = {});

// How long the unit goes on at most when its master dies while it moves at this speed.
double runs_on_s(const ServoConfig& config, double speed_rad_s);

// From kRunsOnSpeed_rad_s, or its greatest speed if that is less, it may go on for so long at most.
constexpr double kRunsOnAtMost_s = 1.0;
constexpr double kRunsOnSpeed_rad_s = 0.349066;  // 20 deg/s
bool runs_on_too_long(const ServoConfig& config);
// The configured greatest speed, or a lower one such that it does not run on for too long; 0 when
// there is none.
double greatest_safe_speed_rad_s(const ServoConfig& config);

enum class Reach { kDirect, kLongWayRound, kUnreachable };

// Whether the unit can point there. Pan angles that differ by 2 pi are the same direction: of the
// reachable ones the one with the shortest way from `now` is chosen; `angles` is changed to it.
// kLongWayRound: a turn the other way, or round a keep-out.
Reach reach(const PtuLimits& limits, const PanTilt& now, PanTilt& angles);

}  // namespace ols
