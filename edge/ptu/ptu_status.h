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
    // Number of failed attempts to open it, and of ports that vanished; only increases.
    std::uint64_t failures = 0;
    // Number of times that it was reopened because the unit did not answer; only increases.
    std::uint64_t reopens = 0;
  } port;
  bool emergency = false;       // if true, nothing moves before clear_emergency()
  bool standing = false;        // the unit was seen to stand still
  bool not_referenced = false;  // the unit must be homed
  bool homing = false;
  std::optional<PtuDoubtCause> doubt;
  std::optional<PtuLoweredSpeed> lowered_speed;
  int line_baud = 0;
  std::optional<double> last_good_s;  // CLOCK_MONOTONIC of the last angle sample
  std::optional<PtuEnvironment> environment;
  PtuCounters counters;
  mount::Limits limits;    // meaningful only once ready
  std::string firmware;    // the unit's answer to V; empty until ready
  std::string last_error;  // error of the port or of the unit; empty if there was none
};

}  // namespace ols::ptu
