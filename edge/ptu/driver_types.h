// The configuration of the PTU driver, and its state and counters.
#pragma once

#include <cstdint>
#include <string>

#include "edge/mount/angle_history.h"
#include "edge/ptu/servo.h"

namespace ols::ptu {

// Whether the driver homes a unit by itself if the reference is missing or in doubt. Homing sweeps
// the whole travel, even if there is an obstacle. Therefore, only the configuration or a person may
// permit it.
enum class PtuRehome {
  kNever,  // the driver reports a fault until a person orders homing or confirms the reference
  kWhenUnreferenced,  // the driver homes the unit once after each loss of the reference
};

// The values in force if the unit accelerates more slowly than configured. The driver then lowers
// the maximum speed, so that the unit still stops in time.
struct PtuLoweredSpeed {
  double acceleration_rad_s2, speed_rad_s;
};

struct PtuConfig {
  std::string device;    // serial device, for example /dev/ttyUSB0
  int baud = 38400;      // baud rate to use
  int line_baud = 9600;  // baud rate of a unit that was just switched on
  // Interval of the poll cycles. Each cycle queries both positions and contains the servo's
  // commands.
  double poll_interval_s = 0.025;
  // After this time without a usable reply, the link counts as lost, and the driver starts again.
  double reply_timeout_s = 0.5;
  double acceleration_rad_s2 = 1.0;  // set in the unit at the start
  // Interval of queries for supply voltage and temperatures; 0 for never.
  double environment_interval_s = 5.0;
  double supply_min_V = 11.5;  // a lower voltage raises an alarm
  PtuRehome rehome = PtuRehome::kNever;
  // True for a unit as delivered: it homes when it is switched on, and answers only when it has
  // finished. Its reference is therefore trusted when it answers the driver for the first time.
  bool homes_at_power_up = true;
  // Permits homing on command although keep-out regions are configured.
  bool home_despite_keep_out = false;
  char step_mode = 0, hold_power = 0, move_power = 0;  // as in PtuStartOptions
  mount::Limits limits;  // as configured; the driver also obeys those that the unit reports
  mount::AngleHistory::Config history;
  ServoConfig servo;
};

enum class PtuState { kStarting, kReady, kFault };

struct PtuCounters {  // counters that only increase
  std::uint64_t requests = 0, replies = 0, timeouts = 0, errors = 0, garbled = 0, restarts = 0;
  std::uint64_t limit_hits = 0;
  // Poll cycles whose position readings contradicted each other or the motion.
  std::uint64_t refused_positions = 0;
  // Number of times that a ready unit began to echo or to send verbose replies.
  std::uint64_t echoes = 0;
  std::uint64_t power_cycles = 0;  // power cycles of the unit that the driver noticed
  std::uint64_t homings = 0;       // homings ordered by the driver
  std::uint64_t emergencies = 0;
};

}  // namespace ols::ptu
