#include "sim/ptu/scan.h"

#include "sim/ptu/command_text.h"

namespace ols::sim {

void PtuScan::power_up() {
  ends_.clear();
  sweeps_ = {};
}

std::optional<std::string> PtuScan::execute(std::string_view command, bool e_series,
                                            double time_s) {
  if (command.empty() || command[0] != 'M') return std::nullopt;
  const std::string_view rest = command.substr(1);
  if (rest == "E" || rest == "D") {
    setup_.scan_at_power_up(rest == "E");
    return "*";
  }
  if (rest == "Q") {
    return setup_.settings().scan_at_power_up ? "* Monitor at power up is ENABLED"
                                              : "* Monitor at power up is DISABLED";
  }
  if (rest == "S" && e_series) {
    return sweeps_[0] ? "* Monitor is ENABLED" : "* Monitor is DISABLED";
  }
  if (rest.empty()) return start(ends_, time_s);
  const auto ends = whole_numbers(rest);
  if (!ends) return kIllegalCommand;
  if (ends->size() != 2 && ends->size() != 4) return kIllegalArgument;
  return start(*ends, time_s);
}

std::string PtuScan::start(const std::vector<int>& wanted, double time_s) {
  const std::vector<int> ends =
      wanted.empty() ? std::vector<int>{motion_.least(0), motion_.greatest(0)} : wanted;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const int axis = static_cast<int>(i / 2);
    if (ends[i] < motion_.least(axis) || ends[i] > motion_.greatest(axis)) return kIllegalArgument;
  }
  ends_ = ends;
  for (std::size_t i = 0; i < ends.size(); i += 2) {
    const double first = ends[i], second = ends[i + 1];
    sweeps_[i / 2] = Sweep{first, second, false, time_s};
    motion_.start(static_cast<int>(i / 2), first, time_s);
  }
  return "*";
}

void PtuScan::advance(double time_s) {
  for (int axis = 0; axis < 2; ++axis) {
    auto& sweep = sweeps_[at(axis)];
    if (!sweep || sweep->first == sweep->second) continue;
    while (motion_.rest_s(axis) <= time_s) {
      sweep->to_second = !sweep->to_second;
      motion_.start(axis, sweep->to_second ? sweep->second : sweep->first, motion_.rest_s(axis));
    }
  }
}

// "Terminated upon receipt of a character, and the pan-tilt is sent to its home position" (M46).
void PtuScan::interrupt(double time_s) {
  for (int axis = 0; axis < 2; ++axis) {
    auto& sweep = sweeps_[at(axis)];
    if (!sweep || time_s <= sweep->begun_s) continue;
    sweep.reset();
    motion_.start(axis, 0.0, time_s);
  }
}

}  // namespace ols::sim
