// The configuration of the PTU driver and what it reports.
#pragma once

#include <cstdint>
#include <string>

#include "edge/mount/angle_history.h"
#include "edge/ptu/servo.h"

namespace ols::ptu {

// Whether the driver homes a unit whose reference is missing or in doubt. Homing sweeps the whole
// travel, even if something stands there, so only the configuration or a person can allow it.
enum class PtuRehome {
  kNever,             // a fault until a person homes the unit or confirms its reference
  kWhenUnreferenced,  // R, once after each loss
};

// The unit accelerates less than configured. The driver therefore limits its speed, so that it
// still stops in time.
struct PtuLoweredSpeed {
  double acceleration_rad_s2, speed_rad_s;
};

struct PtuConfig {
  std::string device;                   // serial device, for example /dev/ttyUSB0
  int baud = 38400;                     // to be used
  int line_baud = 9600;                 // of a unit that was just switched on
  double poll_interval_s = 0.025;       // one request for both positions and the servo's commands
  double reply_timeout_s = 0.5;         // without a usable reply: the link is down, start again
  double acceleration_rad_s2 = 1.0;     // set at start
  double environment_interval_s = 5.0;  // supply voltage and temperatures; 0: never
  double supply_min_V = 11.5;           // a lower one is an alarm
  PtuRehome rehome = PtuRehome::kNever;
  // True as delivered: the unit homes when it is switched on, and does not answer before it has
  // finished. Its reference is therefore trusted when it first answers the driver.
  bool homes_at_power_up = true;
  bool home_despite_keep_out = false;                  // on command
  char step_mode = 0, hold_power = 0, move_power = 0;  // PtuStartOptions
  mount::Limits limits;                                // narrowed by what the unit reports
  mount::AngleHistory::Config history;
  ServoConfig servo;
};

enum class PtuState { kStarting, kReady, kFault };

struct PtuCounters {  // only go up
  std::uint64_t requests = 0, replies = 0, timeouts = 0, errors = 0, garbled = 0, restarts = 0;
  std::uint64_t limit_hits = 0;
  std::uint64_t refused_positions = 0;  // pairs that contradicted each other or the motion
  std::uint64_t echoes = 0;             // echo or verbose replies that came on while ready
  std::uint64_t power_cycles = 0;       // of the unit, noticed by the driver
  std::uint64_t homings = 0;            // ordered by the driver
  std::uint64_t emergencies = 0;
};

}  // namespace ols::ptu
