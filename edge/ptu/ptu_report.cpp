#include "edge/ptu/ptu_report.h"

#include <utility>

#include "conditions/alarms.h"
#include "geometry/angles.h"

namespace ols::ptu {

namespace {

device::DeviceState state_of(const PtuStatus& status) {
  if (!status.port.open) return device::DeviceState::kAbsent;
  switch (status.state) {
    case PtuState::kStarting:
      return device::DeviceState::kStarting;
    case PtuState::kReady:
      return device::DeviceState::kOk;
    case PtuState::kFault:
      break;
  }
  return device::DeviceState::kFault;
}

std::string text_of(const PtuStatus& status, device::DeviceState state) {
  const std::string rate = std::to_string(status.line_baud) + " baud";
  if (state == device::DeviceState::kOk) return ptu_name(status.firmware) + ", " + rate;
  if (state == device::DeviceState::kStarting && status.homing) return "homing, " + rate;
  if (state == device::DeviceState::kStarting) return "starting, " + rate;
  return status.last_error.empty() ? "no unit" : status.last_error;
}

void add_alarms(const PtuConfig& config, const PtuStatus& status, double now_s,
                device::DeviceReport& report) {
  constexpr double kOld_s = 1.0;
  using device::DeviceState;
  const bool silent = !status.last_good_s || now_s - *status.last_good_s > kOld_s;
  const auto raise = [&report](Alarm alarm) { report.alarms.push_back(std::move(alarm)); };
  if (status.emergency) {
    raise(status.standing ? alarm::ptu_emergency_stop() : alarm::ptu_emergency_stop_moving());
  }
  if (report.state == DeviceState::kAbsent) raise(alarm::ptu_no_port(status.last_error));
  if (report.state == DeviceState::kFault) raise(alarm::ptu_halted(status.last_error));
  if (status.not_referenced) raise(alarm::ptu_no_reference());
  if (status.homing) raise(alarm::ptu_homing());
  if (status.doubt && status.last_error != describe(*status.doubt)) raise(alarm_of(*status.doubt));
  if (const auto& lowered = status.lowered_speed) {
    raise(alarm::ptu_accelerates_slowly(degrees(lowered->acceleration_rad_s2),
                                        degrees(lowered->speed_rad_s)));
  }
  if (report.state == DeviceState::kOk && silent) raise(alarm::ptu_no_angles());
  if (status.environment && status.environment->supply_V < config.supply_min_V) {
    raise(alarm::ptu_supply_low(status.environment->supply_V));
  }
}

void add_readings(const PtuStatus& status, device::DeviceReport& report) {
  report.readings["ptu_line_baud"] = status.line_baud;
  if (!status.environment) return;
  const PtuEnvironment& environment = *status.environment;
  report.readings["ptu_supply_V"] = environment.supply_V;
  if (environment.head_degC) report.readings["ptu_head_degC"] = *environment.head_degC;
  if (environment.pan_degC) report.readings["ptu_pan_degC"] = *environment.pan_degC;
  if (environment.tilt_degC) report.readings["ptu_tilt_degC"] = *environment.tilt_degC;
}

void add_counters(const PtuStatus& status, device::DeviceReport& report) {
  const PtuCounters& c = status.counters;
  report.counters = {{"ptu_requests", c.requests},
                     {"ptu_replies", c.replies},
                     {"ptu_timeouts", c.timeouts},
                     {"ptu_errors", c.errors},
                     {"ptu_garbled", c.garbled},
                     {"ptu_restarts", c.restarts},
                     {"ptu_limit_hits", c.limit_hits},
                     {"ptu_refused_positions", c.refused_positions},
                     {"ptu_echoes", c.echoes},
                     {"ptu_power_cycles", c.power_cycles},
                     {"ptu_homings", c.homings},
                     {"ptu_emergencies", c.emergencies},
                     {"ptu_reopens", status.port.reopens},
                     {"ptu_port_failures", status.port.failures}};
}

}  // namespace

device::DeviceReport ptu_report(const PtuConfig& config, const PtuStatus& status, double now_s) {
  const PtuCounters& c = status.counters;
  device::DeviceReport report;
  report.name = "ptu";
  report.state = state_of(status);
  report.text = text_of(status, report.state);
  report.last_good_s = status.last_good_s;
  report.last_error = status.last_error;
  report.errors = status.port.failures + c.timeouts + c.errors + c.garbled + c.restarts +
                  c.refused_positions + c.echoes;
  add_alarms(config, status, now_s, report);
  add_readings(status, report);
  add_counters(status, report);
  return report;
}

}  // namespace ols::ptu
