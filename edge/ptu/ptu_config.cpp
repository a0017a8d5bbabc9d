#include "edge/ptu/ptu_config.h"

#include <algorithm>
#include <string>

#include "conditions/printed.h"
#include "edge/config/config_units.h"
#include "edge/ptu/budget.h"

namespace ols::ptu {

namespace {

constexpr config::Range kPan_deg{-720.0, 720.0}, kTilt_deg{-180.0, 180.0};

// Of the travel and of each region.
void check_order(ConfigTable& table, double pan_min_rad, double pan_max_rad, double tilt_min_rad,
                 double tilt_max_rad) {
  if (pan_min_rad >= pan_max_rad)
    throw table.error("pan_max_deg", "must be greater than pan_min_deg");
  if (tilt_min_rad >= tilt_max_rad)
    throw table.error("tilt_max_deg", "must be greater than tilt_min_deg");
}

std::vector<config::Row> keep_out_rows(mount::KeepOut& region) {
  return {
      config::number("pan_min_deg", region.pan_min_rad, kPan_deg, station::in_degrees(),
                     "Border at the lesser pan angle.")
          .required(),
      config::number("pan_max_deg", region.pan_max_rad, kPan_deg, station::in_degrees(),
                     "Border at the greater pan angle.")
          .required(),
      config::number("tilt_min_deg", region.tilt_min_rad, kTilt_deg, station::in_degrees(),
                     "Lower border.")
          .required(),
      config::number("tilt_max_deg", region.tilt_max_rad, kTilt_deg, station::in_degrees(),
                     "Upper border.")
          .required(),
  };
}

config::Section keep_out_section(mount::Limits& limits) {
  config::Section section{
      "keep_out",
      "A region that the unit never enters or sweeps across, in the angles that "
      "it reports; up to 12 of them."};
  section.append = [&limits] {
    mount::KeepOut& region = limits.keep_out.emplace_back();
    return config::Section{"", "", keep_out_rows(region), {}, [&region](ConfigTable& table) {
                             check_order(table, region.pan_min_rad, region.pan_max_rad,
                                         region.tilt_min_rad, region.tilt_max_rad);
                           }};
  };
  return section;
}

config::Section servo_section(ServoConfig& servo) {
  return {"servo",
          "How the unit follows its goal.",
          {config::number("gain_hz", servo.gain_hz, {0.1, 10.0}, "1/s",
                          "Proportional gain on the angle error."),
           config::number("look_ahead_s", servo.look_ahead_s, {0.05, 2.0}, "s",
                          "The commanded position is this far ahead, and the unit runs on this "
                          "long if the station dies."),
           config::number("max_speed_deg_s", servo.max_speed_rad_s, {0.1, 360.0},
                          station::in_degrees("deg/s"), "Maximum speed of each axis.")}};
}

std::vector<config::Row> line_rows(PtuConfig& c) {
  const std::vector<int> rates{600, 1200, 2400, 4800, 9600, 19200, 38400, 57600, 115200};
  return {
      config::text("device", c.device, "Serial device of the unit.", config::not_empty).required(),
      config::one_of("baud", c.baud, rates, "baud",
                     "Rate to use; 9600 carries 13 polls a second, 38400 carries 40."),
      config::one_of("line_baud", c.line_baud, rates, "baud",
                     "Rate at which a unit may answer that was just switched on."),
      config::number("poll_interval_s", c.poll_interval_s, {0.005, 1.0}, "s",
                     "Interval of the polls; not shorter than the rate can carry."),
      config::number("reply_timeout_s", c.reply_timeout_s, {0.05, 10.0}, "s",
                     "Without a credible reply for this long, the unit is halted and the port "
                     "opened again."),
      config::number("acceleration_deg_s2", c.acceleration_rad_s2, {1.0, 1000.0},
                     station::in_degrees("deg/s^2"), "Acceleration of each axis, set at start."),
      config::number("environment_interval_s", c.environment_interval_s, {0.0, 3600.0}, "s",
                     "Interval of reading supply voltage and temperatures; 0: never."),
      config::number("supply_min_V", c.supply_min_V, {0.0, 60.0}, "V",
                     "A lower supply voltage raises an alarm."),
  };
}

std::vector<config::Row> motion_rows(PtuConfig& c) {
  mount::Limits& l = c.limits;
  return {
      config::number("pan_min_deg", l.pan_min_rad, kPan_deg, station::in_degrees(),
                     "Narrows the unit's own travel."),
      config::number("pan_max_deg", l.pan_max_rad, kPan_deg, station::in_degrees(),
                     "Narrows the unit's own travel."),
      config::number("tilt_min_deg", l.tilt_min_rad, kTilt_deg, station::in_degrees(),
                     "Narrows the unit's own travel."),
      config::number("tilt_max_deg", l.tilt_max_rad, kTilt_deg, station::in_degrees(),
                     "Narrows the unit's own travel."),
      config::flag("homes_at_power_up", c.homes_at_power_up,
                   "The unit's own setting: true as it leaves the factory (RE), false after RD."),
      config::word(
          "rehome", c.rehome,
          {{"never", PtuRehome::kNever}, {"when-unreferenced", PtuRehome::kWhenUnreferenced}},
          "Whether the station homes a unit whose reference is missing or in doubt; "
          "homing sweeps the whole travel."),
      config::flag("home_despite_keep_out", c.home_despite_keep_out,
                   "Lets the operator home a unit that has regions to keep out of."),
      config::word(
          "step_mode", c.step_mode,
          {{"keep", '\0'}, {"auto", 'A'}, {"eighth", 'E'}, {"half", 'H'}, {"quarter", 'Q'}},
          "Step mode of an E-series unit."),
      config::word("hold_power", c.hold_power,
                   {{"keep", '\0'}, {"low", 'L'}, {"off", 'O'}, {"regular", 'R'}},
                   "Power of the motors at rest; off loses the position."),
      config::word("move_power", c.move_power,
                   {{"keep", '\0'}, {"high", 'H'}, {"low", 'L'}, {"regular", 'R'}},
                   "Power of the motors in motion."),
  };
}

void check_limits(ConfigTable& table, const PtuConfig& c) {
  constexpr std::size_t kMaxRegions = 12;  // every cycle searches for a way round them
  check_order(table, c.limits.pan_min_rad, c.limits.pan_max_rad, c.limits.tilt_min_rad,
              c.limits.tilt_max_rad);
  if (c.limits.keep_out.size() > kMaxRegions) throw table.error("keep_out", "at most 12 regions");
  if (c.rehome != PtuRehome::kNever && !c.limits.keep_out.empty())
    throw table.error("rehome", "homing sweeps the whole travel, keep_out and all");
}

void check_budget(ConfigTable& table, const PtuConfig& config) {
  constexpr double kRounding_s = 1e-6;
  const double cycle_s = longest_cycle_s(config.baud);
  if (config.poll_interval_s < cycle_s - kRounding_s) {
    throw table.error(
        "poll_interval_s",
        std::to_string(config.baud) + " baud" +
            printed(" carry a poll in %.3f s, not in %.3f s: a greater baud or interval", cycle_s,
                    config.poll_interval_s));
  }
  if (config.reply_timeout_s < 3.0 * config.poll_interval_s) {
    throw table.error("reply_timeout_s", "must be at least three poll intervals");
  }
}

// The unit has no time-out of its own; position commands make it stop.
void check_running_on(ConfigTable& table, const PtuConfig& config) {
  ServoConfig servo = config.servo;
  servo.max_acceleration_rad_s2 = config.acceleration_rad_s2;
  if (runs_on_too_long(servo)) {
    const double longest_s = runs_on_s(servo, std::min(kRunsOnSpeed_rad_s, servo.max_speed_rad_s));
    throw table.error(
        "servo.look_ahead_s",
        printed("with gain_hz and acceleration_deg_s2 the unit would run on for %.2f s "
                "when this program dies, at most %.1f s is allowed",
                longest_s, kRunsOnAtMost_s));
  }
}

// A unit's motion deviates from its commanded profile by about this share of its acceleration.
constexpr double kAccelerationSdShare = 0.04;

}  // namespace

config::Section ptu_section(PtuConfig& c) {
  auto rows = line_rows(c);
  std::ranges::move(motion_rows(c), std::back_inserter(rows));
  return {"mount",
          "",
          rows,
          {keep_out_section(c.limits), servo_section(c.servo)},
          [&c](ConfigTable& table) {
            check_limits(table, c);
            check_budget(table, c);
            check_running_on(table, c);
            c.history.acceleration_max_rad_s2 = c.acceleration_rad_s2;
            c.history.acceleration_sd_rad_s2 = kAccelerationSdShare * c.acceleration_rad_s2;
          }};
}

}  // namespace ols::ptu
