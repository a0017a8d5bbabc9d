// The state of a PTU at one moment. Pure.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "edge/ptu/driver.h"

namespace ols::ptu {

struct PtuStatus {
  PtuState state = PtuState::kStarting;
  struct Port {
    bool open = false;
    std::uint64_t failures = 0;  // opens that failed and ports that vanished; only goes up
    std::uint64_t reopens = 0;   // because the unit did not answer; only goes up
  } port;
  bool emergency = false;       // nothing moves until clear_emergency()
  bool standing = false;        // seen not to move
  bool not_referenced = false;  // must be homed
  bool homing = false;
  std::optional<PtuDoubtCause> doubt;
  std::optional<PtuLoweredSpeed> lowered_speed;
  int line_baud = 0;
  std::optional<double> last_good_s;  // CLOCK_MONOTONIC of the last angle
  std::optional<PtuEnvironment> environment;
  PtuCounters counters;
  mount::Limits limits;    // meaningful once ready
  std::string firmware;    // the unit's answer to V; empty until ready
  std::string last_error;  // of the port or of the unit; empty: no error so far
};

}  // namespace ols::ptu
