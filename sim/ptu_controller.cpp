#include "sim/ptu_controller.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

namespace ols::sim {

namespace {

std::string upper(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return result;
}

}  // namespace

std::optional<int> whole_number(std::string_view text) {
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::optional<std::vector<int>> whole_numbers(std::string_view text) {
  std::vector<int> values;
  while (true) {
    const std::size_t comma = std::min(text.find(','), text.size());
    const auto value = whole_number(text.substr(0, comma));
    if (!value) return std::nullopt;
    values.push_back(*value);
    if (comma == text.size()) return values;
    text.remove_prefix(comma + 1);
  }
}

PtuController::PtuController(const PtuUnitConfig& config, double power_up_s)
    : config_(config),
      settings_(factory_settings()),
      axes_{{{PtuAxis(0.0, power_up_s),
              "Pan",
              config.pan_min_counts,
              config.pan_max_counts,
              1,
              0.0,
              config.homed_before,
              {},
              {},
              {}},
             {PtuAxis(0.0, power_up_s),
              "Tilt",
              config.tilt_min_counts,
              config.tilt_max_counts,
              1,
              0.0,
              config.homed_before,
              {},
              {},
              {}}}},
      homes_{config.home_at_power_up, config.home_at_power_up},
      baud_(config.baud),
      baud_at_power_up_(config.baud) {
  settings_.echo = config.echo;
  settings_.feedback = config.verbose ? Feedback::kVerbose : Feedback::kTerse;
  saved_ = settings_;
}

PtuAnswer PtuController::power_up(double time_s) {
  settings_ = saved_;
  velocity_mode_ = false;
  immediate_ = true;
  limits_ = Limits::kFactory;
  selected_ = settings_.unit_id == 0;
  baud_ = baud_at_power_up_;
  tokens_.clear();
  scan_ends_.clear();
  for (Axis& axis : axes_) {
    axis.slaved.reset();
    axis.hit_s.reset();
    axis.sweep.reset();
  }
  PtuAnswer answer{"*", home(homes_[0], homes_[1], time_s)};
  if (settings_.scan_at_power_up) start_scan({}, answer.ready_s);
  if (!selected_) answer.text.clear();
  return answer;
}

PtuAnswer PtuController::power_cycle(double time_s) {
  for (int axis = 0; axis < 2; ++axis) {
    Axis& a = axes_[at(axis)];
    a.motion.halt(profile(axis), time_s);
    a.origin = a.motion.target();
    a.homed = false;
  }
  return power_up(time_s);
}

PtuAnswer PtuController::execute(std::string_view command_text, double time_s) {
  PtuAnswer answer = dispatch(upper(command_text), time_s);
  if (!selected_ || settings_.feedback == Feedback::kOff) answer.text.clear();
  return answer;
}

PtuAnswer PtuController::dispatch(const std::string& command, double time_s) {
  if (!selected_ && command[0] != '_') return {"", time_s};
  if (const auto answer = blocking(command, time_s)) return *answer;
  constexpr std::array<Handler, 12> kHandlers{
      &PtuController::modes,         &PtuController::toggles,     &PtuController::limit_modes,
      &PtuController::halts,         &PtuController::information, &PtuController::homing_choice,
      &PtuController::keeping,       &PtuController::host_port,   &PtuController::unit_id,
      &PtuController::e_series_only, &PtuController::scan,        &PtuController::preset};
  for (const Handler handler : kHandlers) {
    if (const auto answer = (this->*handler)(command, time_s)) return {*answer, time_s};
  }
  const bool of_axis = command.size() >= 2 && (command[0] == 'P' || command[0] == 'T');
  if (!of_axis) return {kIllegalCommand, time_s};
  const bool slow = std::string_view("ABUL").find(command[1]) != std::string_view::npos;
  const bool sets = command.size() > 2;
  return {axis_command(command[0] == 'P' ? 0 : 1, command.substr(1), time_s),
          time_s + (slow && sets ? config_.parameter_set_s : 0.0)};
}

// What is answered when the motion is over.
std::optional<PtuAnswer> PtuController::blocking(std::string_view command, double time_s) {
  if (command == "A") {
    start_slaved(time_s);
    return PtuAnswer{"*", std::max({time_s, axes_[0].motion.rest_s(), axes_[1].motion.rest_s()})};
  }
  if (command == "R") return PtuAnswer{"*", home(true, true, time_s)};
  if (!e_series()) return std::nullopt;
  // On a D46 these choose what is homed at power-up.
  if (command == "RP") return PtuAnswer{"*", home(true, false, time_s)};
  if (command == "RT") return PtuAnswer{"*", home(false, true, time_s)};
  if (command == "RS") return PtuAnswer{"*", home_together(time_s)};
  return std::nullopt;
}

void PtuController::slip(int axis, int slipped_counts, double time_s) {
  Axis& a = axes_[at(axis)];
  a.motion.shift(slipped_counts, time_s);
  a.origin += slipped_counts;
}

void PtuController::forget(double before_s) {
  for (Axis& axis : axes_) axis.motion.forget(before_s);
}

}  // namespace ols::sim
