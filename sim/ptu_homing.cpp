// Motions that the simulated PTU makes by itself: homing, scans and presets.
#include <algorithm>
#include <cmath>

#include "sim/ptu_controller.h"

namespace ols::sim {

namespace {

constexpr int kGreatestPreset = 32;  // PTU-D300's manual, 4.3.11

}  // namespace

// Tilt first. Without homing the counters begin where the mechanism stands. Returns when it is
// over.
double PtuController::home(bool pan, bool tilt, double time_s) {
  double end_s = time_s;
  for (const int axis : {1, 0}) {
    if (axis == 0 ? pan : tilt) end_s = home_axis(axis, end_s);
  }
  if (pan || tilt) end_s = std::max({end_s, axes_[0].motion.rest_s(), axes_[1].motion.rest_s()});
  return end_s;
}

double PtuController::home_together(double time_s) {
  home_axis(1, time_s);
  home_axis(0, time_s);
  std::stable_sort(tokens_.begin(), tokens_.end(),
                   [](const PtuToken& a, const PtuToken& b) { return a.time_s < b.time_s; });
  return std::max(axes_[0].motion.rest_s(), axes_[1].motion.rest_s());
}

// To both ends, then towards zero. Returns when the second end is reached.
double PtuController::home_axis(int axis, double time_s) {
  Axis& a = axes_[at(axis)];
  take_step_mode(axis);
  PtuAxis::Profile homing = profile(axis);
  homing.speed = static_cast<double>(settings_.axes[at(axis)].home_speed) * a.divisor;
  homing.acceleration = 2.0 * homing.speed;
  a.slaved.reset();
  a.hit_s.reset();
  a.sweep.reset();
  double end_s = time_s;
  for (const int end : {a.least, a.greatest}) {
    a.motion.move(end, homing, end_s);
    end_s = a.motion.rest_s();
    tokens_.push_back({end_s, axis == 0 ? "!P" : "!T"});
  }
  a.motion.move(0.0, homing, end_s);
  a.origin = 0.0;
  a.homed = true;
  return end_s;
}

// A new step mode holds from the next reset on: one count is then more or fewer steps.
void PtuController::take_step_mode(int axis) {
  Axis& a = axes_[at(axis)];
  AxisSettings& s = settings_.axes[at(axis)];
  const int divisor = s.step_mode == 'F' ? 8 : s.step_mode == 'H' ? 4 : s.step_mode == 'Q' ? 2 : 1;
  if (divisor == a.divisor) return;
  for (int* value : {&s.speed, &s.acceleration, &s.base_speed, &s.upper_speed, &s.lower_speed,
                     &s.user_least, &s.user_greatest, &s.home_speed}) {
    *value = *value * a.divisor / divisor;
  }
  a.divisor = divisor;
}

std::optional<std::string> PtuController::scan(std::string_view command, double time_s) {
  if (command.empty() || command[0] != 'M') return std::nullopt;
  const std::string_view rest = command.substr(1);
  if (rest == "E" || rest == "D") {
    settings_.scan_at_power_up = saved_.scan_at_power_up = rest == "E";
    return "*";
  }
  if (rest == "Q") {
    return settings_.scan_at_power_up ? "* Monitor at power up is ENABLED"
                                      : "* Monitor at power up is DISABLED";
  }
  if (rest == "S" && e_series()) {
    return axes_[0].sweep ? "* Monitor is ENABLED" : "* Monitor is DISABLED";
  }
  if (rest.empty()) return start_scan(scan_ends_, time_s);
  const auto ends = whole_numbers(rest);
  if (!ends) return kIllegalCommand;
  if (ends->size() != 2 && ends->size() != 4) return kIllegalArgument;
  return start_scan(*ends, time_s);
}

std::string PtuController::start_scan(const std::vector<int>& wanted, double time_s) {
  const std::vector<int> ends = wanted.empty() ? std::vector<int>{least(0), greatest(0)} : wanted;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const int axis = static_cast<int>(i / 2);
    if (ends[i] < least(axis) || ends[i] > greatest(axis)) return kIllegalArgument;
  }
  scan_ends_ = ends;
  for (std::size_t i = 0; i < ends.size(); i += 2) {
    Axis& a = axes_[i / 2];
    a.sweep = Sweep{steps(a, ends[i]), steps(a, ends[i + 1]), false, time_s};
    start(static_cast<int>(i / 2), a.sweep->first, time_s);
  }
  return "*";
}

void PtuController::advance(double time_s) {
  for (int axis = 0; axis < 2; ++axis) {
    Axis& a = axes_[at(axis)];
    if (a.sweep && a.sweep->first == a.sweep->second) continue;
    while (a.sweep && a.motion.rest_s() <= time_s) {
      a.sweep->to_second = !a.sweep->to_second;
      start(axis, a.sweep->to_second ? a.sweep->second : a.sweep->first, a.motion.rest_s());
    }
  }
}

// "Terminated upon receipt of a character, and the pan-tilt is sent to its home position" (M46).
void PtuController::interrupt(double time_s) {
  for (int axis = 0; axis < 2; ++axis) {
    Axis& a = axes_[at(axis)];
    if (!a.sweep || time_s <= a.sweep->begun_s) continue;
    a.sweep.reset();
    start(axis, steps(a, 0.0), time_s);
  }
}

std::optional<std::string> PtuController::preset(std::string_view command, double time_s) {
  const bool known = command.size() >= 2 && command[0] == 'X' &&
                     std::string_view("SGC").find(command[1]) != std::string_view::npos;
  if (!known || !has_presets()) return std::nullopt;
  if (command == "XC") {  // as a public driver sends it
    presets_.clear();
    return "*";
  }
  const auto index = whole_number(command.substr(2));
  if (!index || *index < 0 || *index > kGreatestPreset) return kIllegalArgument;
  if (command[1] == 'C') {
    presets_.erase(*index);
    return "*";
  }
  if (command[1] == 'S') {
    presets_[*index] = {
        static_cast<int>(std::lround(counts(axes_[0], axes_[0].motion.position(time_s)))),
        static_cast<int>(std::lround(counts(axes_[1], axes_[1].motion.position(time_s))))};
    return "*";
  }
  const auto place = presets_.find(*index);
  if (place == presets_.end()) return kIllegalArgument;
  const std::string pan = set_position(0, place->second.first, time_s);
  return pan == "*" ? set_position(1, place->second.second, time_s) : pan;
}

}  // namespace ols::sim
