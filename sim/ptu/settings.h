// The settings that the simulated PTU saves by its command DS.
#pragma once

#include <array>
#include <cstddef>

#include "sim/ptu/unit.h"

namespace ols::sim {

// Pan is axis 0, tilt is axis 1.
constexpr std::size_t at(int axis) { return static_cast<std::size_t>(axis); }
constexpr const char* ptu_axis_name(int axis) { return axis == 0 ? "Pan" : "Tilt"; }

enum class PtuFeedback { kVerbose, kTerse, kOff };

struct PtuAxisSettings {  // positions and speeds in the unit's counts
  int speed, acceleration, base_speed, upper_speed, lower_speed;
  char hold_power, move_power, step_mode;
  int user_least, user_greatest;
  int home_speed;  // [counts/s] of the commands RPS and RTS
};

struct PtuSettings {
  bool echo;
  PtuFeedback feedback;
  std::array<PtuAxisSettings, 2> axes;
  int unit_id;
  bool scan_at_power_up;
  bool encoder_correction;
};

PtuSettings factory_settings(const PtuUnitConfig& config);

}  // namespace ols::sim
