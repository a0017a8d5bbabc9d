#include "sim/scenario/fault_plan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace ols::sim {
namespace {

constexpr const char* kEveryKind = "all";  // in a command that ends faults

struct Kind {
  const char* name;
  double fallback, least, greatest;  // of the value; all equal: the kind takes no value
  void (*apply)(StationFaults&, double value);
};

constexpr Kind flag(const char* name, void (*apply)(StationFaults&, double)) {
  return {name, 1.0, 1.0, 1.0, apply};
}

using F = StationFaults;

// 1: homes by itself, 0: does not.
void apply_power_cycle(F& f, double value) {
  f.ptu.power_cycle = true;
  if (!std::isnan(value)) f.ptu.homes_then = value != 0.0;
}

const std::array kKinds = {
    flag("ptu-line-cut", [](F& f, double) { f.ptu.line_cut = true; }),
    flag("ptu-line-gone", [](F& f, double) { f.ptu.line_gone = true; }),
    Kind{"ptu-garbled", 0.01, 0.0, 1.0, [](F& f, double v) { f.ptu.garble_share = v; }},
    Kind{"ptu-reply-lost", 60.0, 0.01, 1e6, [](F& f, double v) { f.ptu.reply_lost_every_s = v; }},
    flag("ptu-echo-on", [](F& f, double) { f.ptu.echo_on = true; }),
    Kind{"ptu-power-cycle", std::nan(""), 0.0, 1.0, apply_power_cycle},
    Kind{"ptu-lost-steps", 1.0, -90.0, 90.0, [](F& f, double v) { f.ptu.lost_steps_deg = v; }},
    Kind{"ptz-late", 1.0, 0.0, 10.0, [](F& f, double v) { f.ptu.ptz.late_s = v; }},
    Kind{"ptz-steps", 1.0, 0.0, 90.0, [](F& f, double v) { f.ptu.ptz.step_deg = v; }},
    flag("ptz-frozen", [](F& f, double) { f.ptu.ptz.frozen = true; }),
    flag("ptz-no-position", [](F& f, double) { f.ptu.ptz.no_position = true; }),
    flag("ptz-ignores-timeout", [](F& f, double) { f.ptu.ptz.ignores_timeout = true; }),
    flag("ptz-ignores-stop", [](F& f, double) { f.ptu.ptz.ignores_stop = true; }),
    Kind{"ptz-clock-off", 3600.0, -1e9, 1e9, [](F& f, double v) { f.ptu.ptz.clock_off_s = v; }},
    Kind{"ptz-connection-lost", 1.0, 0.0, 1.0, [](F& f, double v) { f.ptu.ptz.lost_share = v; }},
    flag("ptz-reboots", [](F& f, double) { f.ptu.ptz.reboots = true; }),
    flag("camera-gone", [](F& f, double) { f.camera.gone = true; }),
    Kind{"camera-packet-loss", 0.001, 0.0, 1.0, [](F& f, double v) { f.camera.packet_loss = v; }},
    Kind{"camera-lying-rate", 0.16, 0.0, 0.9, [](F& f, double v) { f.camera.missing_rate = v; }},
    Kind{"camera-clock-off", 1.0, -1e6, 1e6, [](F& f, double v) { f.camera.clock_off_s = v; }},
    Kind{"camera-clock-drift", 1e-3, -1.0, 1.0, [](F& f, double v) { f.camera.clock_drift = v; }},
    flag("camera-no-resend", [](F& f, double) { f.camera.no_resend = true; }),
    flag("camera-wrong-format", [](F& f, double) { f.camera.pixel_format = "BayerRG8"; }),
    flag("gnss-silent", [](F& f, double) { f.gnss.silent = true; }),
    flag("gnss-no-fix", [](F& f, double) { f.gnss.no_fix = true; }),
    Kind{"gnss-jump", 100.0, -1e6, 1e6, [](F& f, double v) { f.gnss.jump_m = v; }},
    Kind{"gnss-garbled", 0.01, 0.0, 1.0, [](F& f, double v) { f.gnss.garble_share = v; }},
    flag("inclinometer-silent", [](F& f, double) { f.inclinometer.silent = true; }),
    flag("inclinometer-stuck", [](F& f, double) { f.inclinometer.stuck = true; }),
    Kind{"inclinometer-garbled", 0.01, 0.0, 1.0,
         [](F& f, double v) { f.inclinometer.garble_share = v; }},
    flag("emergency-stop", [](F& f, double) { f.stop_pressed = true; }),
    flag("rearm-button", [](F& f, double) { f.rearm_held = true; }),
    flag("target-level-line", [](F& f, double) { f.by_hand.level_line = true; }),
    flag("target-cross", [](F& f, double) { f.by_hand.cross = true; }),
    flag("target-rulers", [](F& f, double) { f.by_hand.rulers = true; }),
    flag("sun-filter", [](F& f, double) { f.by_hand.sun_filter = true; }),
};

const Kind* find(std::string_view name) {
  const auto* found = std::find_if(kKinds.begin(), kKinds.end(),
                                   [name](const Kind& kind) { return kind.name == name; });
  return found == kKinds.end() ? nullptr : found;
}

bool ends(const Fault& command, const Fault& fault) {
  return (command.kind == kEveryKind || fault.kind == command.kind) &&
         (command.station.empty() || fault.station == command.station);
}

}  // namespace

std::vector<std::string> fault_kinds() {
  std::vector<std::string> names;
  for (const Kind& kind : kKinds) names.emplace_back(kind.name);
  return names;
}

FaultProblem check(const Fault& fault) {
  const Kind* kind = find(fault.kind);
  if (kind == nullptr) return {"kind", "unknown kind of fault \"" + fault.kind + "\""};
  if (!(fault.at_s >= 0.0) || std::isinf(fault.at_s)) return {"at_s", "must be at least 0"};
  if (!(fault.for_s > 0.0)) return {"for_s", "must be more than 0"};
  if (std::isnan(fault.value)) return {};
  if (fault.value < kind->least || fault.value > kind->greatest) {
    if (kind->least == kind->greatest) return {"value", fault.kind + " takes no value"};
    return {"value", fault.kind + " takes " + std::to_string(kind->least) + " to " +
                         std::to_string(kind->greatest)};
  }
  return {};
}

void FaultPlan::add(const Fault& fault) {
  const FaultProblem problem = check(fault);
  if (!problem.key.empty()) throw std::invalid_argument(problem.key + ": " + problem.what);
  faults_.push_back(fault);
}

void FaultPlan::command(Fault fault, double now_s) {
  forget(now_s);
  if (fault.for_s == 0.0) {
    if (fault.kind != kEveryKind && find(fault.kind) == nullptr) {
      throw std::invalid_argument("kind: unknown kind of fault \"" + fault.kind + "\"");
    }
    std::erase_if(faults_, [&fault](const Fault& f) { return ends(fault, f); });
    return;
  }
  fault.at_s = now_s;
  add(fault);
}

void FaultPlan::forget(double before_s) {
  std::erase_if(faults_, [before_s](const Fault& f) { return f.at_s + f.for_s <= before_s; });
}

StationFaults FaultPlan::at(std::string_view station, double time_s) const {
  std::vector<const Fault*> holding;
  for (const Fault& fault : faults_) {
    const bool here = fault.station.empty() || fault.station == station;
    if (here && time_s >= fault.at_s && time_s < fault.at_s + fault.for_s) {
      holding.push_back(&fault);
    }
  }
  std::stable_sort(holding.begin(), holding.end(),
                   [](const Fault* a, const Fault* b) { return a->at_s < b->at_s; });
  StationFaults faults;
  for (const Fault* fault : holding) {
    const Kind& kind = *find(fault->kind);
    kind.apply(faults, std::isnan(fault->value) ? kind.fallback : fault->value);
  }
  return faults;
}

}  // namespace ols::sim
