#include "edge/ptu/ptu_config.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include "edge/ptu/budget.h"
#include "geometry/angles.h"

namespace ols {

namespace {

double angle(ConfigTable& table, std::string_view key, double fallback_rad, double least_deg,
             double greatest_deg) {
  return radians(table.number(key, degrees(fallback_rad), least_deg, greatest_deg));
}

// Two keys of a range, the lesser one first.
void read_range(ConfigTable& table, const std::string& least_key, const std::string& greatest_key,
                double limit_deg, double& least_rad, double& greatest_rad) {
  least_rad = angle(table, least_key, least_rad, -limit_deg, limit_deg);
  greatest_rad = angle(table, greatest_key, greatest_rad, -limit_deg, limit_deg);
  if (least_rad >= greatest_rad) {
    throw table.error(greatest_key, "must be greater than " + least_key);
  }
}

KeepOut read_keep_out(ConfigTable& table) {
  KeepOut region;
  for (const char* key : {"pan_min_deg", "pan_max_deg", "tilt_min_deg", "tilt_max_deg"}) {
    table.required_number(key, -720.0, 720.0);
  }
  read_range(table, "pan_min_deg", "pan_max_deg", 720.0, region.pan_min_rad, region.pan_max_rad);
  read_range(table, "tilt_min_deg", "tilt_max_deg", 180.0, region.tilt_min_rad,
             region.tilt_max_rad);
  return region;
}

PtuLimits read_limits(ConfigTable& table) {
  constexpr std::size_t kMostRegions = 12;  // a way round is searched for in every cycle
  PtuLimits limits;
  read_range(table, "pan_min_deg", "pan_max_deg", 720.0, limits.pan_min_rad, limits.pan_max_rad);
  read_range(table, "tilt_min_deg", "tilt_max_deg", 180.0, limits.tilt_min_rad,
             limits.tilt_max_rad);
  for (ConfigTable* region : table.tables("keep_out")) {
    limits.keep_out.push_back(read_keep_out(*region));
  }
  if (limits.keep_out.size() > kMostRegions) throw table.error("keep_out", "at most 12 regions");
  return limits;
}

// The letter of the mode that the key names; 0: as the unit has it.
char letter(ConfigTable& table, std::string_view key, const std::map<std::string, char>& letters) {
  std::vector<std::string> names{"keep"};
  for (const auto& [name, unused] : letters) names.push_back(name);
  const std::string chosen = table.choice(key, "keep", names);
  return chosen == "keep" ? '\0' : letters.at(chosen);
}

void read_modes(ConfigTable& table, PtuConfig& config) {
  config.step_mode =
      letter(table, "step_mode", {{"half", 'H'}, {"quarter", 'Q'}, {"eighth", 'E'}, {"auto", 'A'}});
  config.hold_power = letter(table, "hold_power", {{"regular", 'R'}, {"low", 'L'}, {"off", 'O'}});
  config.move_power = letter(table, "move_power", {{"high", 'H'}, {"regular", 'R'}, {"low", 'L'}});
  const std::string rehome = table.choice("rehome", "never", {"never", "when-unreferenced"});
  config.rehome = rehome == "never" ? PtuRehome::kNever : PtuRehome::kWhenUnreferenced;
  config.homes_at_power_up = table.boolean("homes_at_power_up", config.homes_at_power_up);
  config.home_despite_keep_out =
      table.boolean("home_despite_keep_out", config.home_despite_keep_out);
  if (config.rehome != PtuRehome::kNever && !config.limits.keep_out.empty()) {
    throw table.error("rehome", "homing sweeps the whole travel, keep_out and all");
  }
}

int rate(ConfigTable& table, std::string_view key, int fallback) {
  const int baud = static_cast<int>(table.integer(key, fallback, 600, 115200));
  for (const int known : {600, 1200, 2400, 4800, 9600, 19200, 38400, 57600, 115200}) {
    if (baud == known) return baud;
  }
  throw table.error(key, "is not a rate of serial lines");
}

std::string text(const char* format, double a, double b) {
  char line[160];
  std::snprintf(line, sizeof line, format, a, b);
  return line;
}

// What does not go together.
void check_budget(ConfigTable& table, const PtuConfig& config) {
  constexpr double kRounding_s = 1e-6;
  const double cycle_s = longest_cycle_s(config.baud);
  if (config.poll_interval_s < cycle_s - kRounding_s) {
    throw table.error("poll_interval_s",
                      std::to_string(config.baud) + " baud" +
                          text(" carry a poll in %.3f s, not in %.3f s: a greater baud or interval",
                               cycle_s, config.poll_interval_s));
  }
  if (config.reply_timeout_s < 3.0 * config.poll_interval_s) {
    throw table.error("reply_timeout_s", "must be at least three poll intervals");
  }
}

// The unit has no time-out of its own: how it is commanded sees to it that it stops.
void check_running_on(ConfigTable& table, const PtuConfig& config) {
  ServoConfig servo = config.servo;
  servo.max_acceleration_rad_s2 = config.acceleration_rad_s2;
  if (runs_on_too_long(servo)) {
    const double longest_s = runs_on_s(servo, std::min(kRunsOnSpeed_rad_s, servo.max_speed_rad_s));
    throw table.error("servo.look_ahead_s",
                      text("with gain_hz and acceleration_deg_s2 the unit would run on for %.2f s "
                           "when this program dies, at most %.1f s is allowed",
                           longest_s, kRunsOnAtMost_s));
  }
}

ServoConfig read_servo(ConfigTable& table) {
  ServoConfig servo;
  servo.gain_hz = table.number("gain_hz", servo.gain_hz, 0.1, 10.0);
  servo.look_ahead_s = table.number("look_ahead_s", servo.look_ahead_s, 0.05, 2.0);
  servo.max_speed_rad_s = angle(table, "max_speed_deg_s", servo.max_speed_rad_s, 0.1, 360.0);
  servo.goal_timeout_s = table.number("goal_timeout_s", servo.goal_timeout_s, 0.05, 10.0);
  return servo;
}

AngleHistory::Config read_angles(ConfigTable& table, double acceleration_rad_s2) {
  constexpr double kShare = 0.04;
  AngleHistory::Config angles;
  angles.span_s = table.number("span_s", angles.span_s, 0.5, 60.0);
  angles.max_gap_s = table.number("max_gap_s", angles.max_gap_s, 0.01, 2.0);
  angles.max_extrapolation_s =
      table.number("max_extrapolation_s", angles.max_extrapolation_s, 0.0, 1.0);
  angles.acceleration_max_rad_s2 = acceleration_rad_s2;
  angles.acceleration_sd_rad_s2 =
      angle(table, "acceleration_sd_deg_s2", kShare * acceleration_rad_s2, 0.0, 1000.0);
  return angles;
}

}  // namespace

PtuConfig read_ptu_config(ConfigTable& table) {
  PtuConfig config;
  config.device = table.required_text("device");
  if (config.device.empty()) throw table.error("device", "must not be empty");
  config.baud = rate(table, "baud", config.baud);
  config.line_baud = rate(table, "line_baud", config.line_baud);
  config.poll_interval_s = table.number("poll_interval_s", config.poll_interval_s, 0.005, 1.0);
  config.reply_timeout_s = table.number("reply_timeout_s", config.reply_timeout_s, 0.05, 10.0);
  config.acceleration_rad_s2 =
      angle(table, "acceleration_deg_s2", config.acceleration_rad_s2, 1.0, 1000.0);
  config.environment_interval_s =
      table.number("environment_interval_s", config.environment_interval_s, 0.0, 3600.0);
  config.supply_min_V = table.number("supply_min_V", config.supply_min_V, 0.0, 60.0);
  config.limits = read_limits(table);
  read_modes(table, config);
  config.servo = read_servo(table.table("servo"));
  config.history = read_angles(table.table("angles"), config.acceleration_rad_s2);
  check_budget(table, config);
  check_running_on(table, config);
  return config;
}

}  // namespace ols
