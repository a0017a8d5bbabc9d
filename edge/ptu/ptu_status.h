// The state of a PTU at one instant. Pure.
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
    // Number of failed attempts to open the port, plus number of times that the port vanished; only
    // increases.
    std::uint64_t failures = 0;
    // Number of times that the port was reopened because the unit did not answer; only increases.
    std::uint64_t reopens = 0;
  } port;
  bool emergency = false;       // true: the unit must not move before clear_emergency()
  bool standing = false;        // the reported positions do not change
  bool not_referenced = false;  // the unit must be homed
  bool homing = false;
  std::optional<PtuDoubtCause> doubt;
  std::optional<PtuLoweredSpeed> lowered_speed;
  int line_baud = 0;
  // CLOCK_MONOTONIC at the arrival of the last accepted positions
  std::optional<double> last_good_s;
  std::optional<PtuEnvironment> environment;
  PtuCounters counters;
  mount::Limits limits;    // as configured until the unit is ready, then as in PtuDriver::limits()
  std::string firmware;    // the unit's answer to V; empty until ready
  std::string last_error;  // last error of the port or of the unit; empty if there was none
};

}  // namespace ols::ptu
