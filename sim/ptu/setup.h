// The simulated PTU's settings, and the commands that change, select and save them. None of these
// commands moves the unit.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "sim/ptu/settings.h"

namespace ols::sim {

class PtuSetup {
 public:
  explicit PtuSetup(const PtuUnitConfig& config);

  // Powers up: restores the saved settings.
  void power_up();

  // Executes a settings command and returns the answer; nullopt: the command is not one.
  std::optional<std::string> execute(std::string_view command);

  // Sets or queries the power of one axis. `what`: the command without the axis letter: H or M,
  // with or without a level.
  std::string power(int axis, std::string_view what);
  // Sets or queries a user limit of one axis. `what`: NU or XU, with or without a value [counts],
  // which must be within the factory's limits.
  std::string user_limit(int axis, std::string_view what, int factory_limit);

  void scan_at_power_up(bool scans);
  void home_at_power_up(bool homes) { homes_ = {homes, homes}; }
  void switch_echo_on() { settings_.echo = true; }

  PtuSettings& settings() { return settings_; }
  const PtuSettings& settings() const { return settings_; }
  bool verbose() const { return settings_.feedback == PtuFeedback::kVerbose; }
  bool selected() const { return selected_; }
  int baud() const { return baud_; }
  bool homes(int axis) const { return homes_[at(axis)]; }

 private:
  bool e_series() const { return config_.model == PtuModel::kE46; }
  std::optional<std::string> toggles(std::string_view command);
  std::optional<std::string> homing_choice(std::string_view command);
  std::optional<std::string> keeping(std::string_view command);
  std::optional<std::string> host_port(std::string_view command);
  std::optional<std::string> unit_id(std::string_view command);
  std::optional<std::string> encoder_correction(std::string_view command);
  std::optional<std::string> step_mode(std::string_view command);
  std::string homing_speed(int axis, std::string_view wanted);

  PtuUnitConfig config_;
  PtuSettings settings_, saved_;
  std::array<bool, 2> homes_;  // which axes home at power-up; saved immediately
  bool selected_ = true;       // whether this one of several units on the line is addressed
  int baud_, baud_at_power_up_;
};

}  // namespace ols::sim
