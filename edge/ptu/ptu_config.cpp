#include "edge/ptu/ptu_config.h"

#include "geometry/angles.h"

namespace ols {

namespace {

double angle(ConfigTable& table, std::string_view key, double fallback_rad, double least_deg,
             double greatest_deg) {
  return radians(table.number(key, degrees(fallback_rad), least_deg, greatest_deg));
}

PtuLimits read_limits(ConfigTable& table) {
  PtuLimits limits;
  limits.pan_min_rad = angle(table, "pan_min_deg", limits.pan_min_rad, -720.0, 720.0);
  limits.pan_max_rad = angle(table, "pan_max_deg", limits.pan_max_rad, -720.0, 720.0);
  limits.tilt_min_rad = angle(table, "tilt_min_deg", limits.tilt_min_rad, -180.0, 180.0);
  limits.tilt_max_rad = angle(table, "tilt_max_deg", limits.tilt_max_rad, -180.0, 180.0);
  if (limits.pan_min_rad >= limits.pan_max_rad) {
    throw table.error("pan_max_deg", "must be greater than pan_min_deg");
  }
  if (limits.tilt_min_rad >= limits.tilt_max_rad) {
    throw table.error("tilt_max_deg", "must be greater than tilt_min_deg");
  }
  return limits;
}

ServoConfig read_servo(ConfigTable& table) {
  ServoConfig servo;
  servo.gain_hz = table.number("gain_hz", servo.gain_hz, 0.1, 10.0);
  servo.look_ahead_s = table.number("look_ahead_s", servo.look_ahead_s, 0.05, 2.0);
  servo.max_speed_rad_s = angle(table, "max_speed_deg_s", servo.max_speed_rad_s, 0.1, 360.0);
  servo.goal_timeout_s = table.number("goal_timeout_s", servo.goal_timeout_s, 0.05, 10.0);
  return servo;
}

AngleHistory::Config read_angles(ConfigTable& table) {
  AngleHistory::Config angles;
  angles.span_s = table.number("span_s", angles.span_s, 0.5, 60.0);
  angles.max_gap_s = table.number("max_gap_s", angles.max_gap_s, 0.01, 2.0);
  angles.max_extrapolation_s =
      table.number("max_extrapolation_s", angles.max_extrapolation_s, 0.0, 1.0);
  angles.acceleration_sd_rad_s2 =
      angle(table, "acceleration_sd_deg_s2", angles.acceleration_sd_rad_s2, 0.0, 1000.0);
  return angles;
}

}  // namespace

PtuConfig read_ptu_config(ConfigTable& table) {
  PtuConfig config;
  config.device = table.required_text("device");
  if (config.device.empty()) throw table.error("device", "must not be empty");
  config.baud = static_cast<int>(table.integer("baud", config.baud, 600, 115200));
  bool known = false;
  for (const int rate : {600, 1200, 2400, 4800, 9600, 19200, 38400, 57600, 115200}) {
    known = known || config.baud == rate;
  }
  if (!known) throw table.error("baud", "is not a rate of serial lines");
  config.poll_interval_s = table.number("poll_interval_s", config.poll_interval_s, 0.005, 1.0);
  config.reply_timeout_s = table.number("reply_timeout_s", config.reply_timeout_s, 0.05, 10.0);
  config.acceleration_rad_s2 =
      angle(table, "acceleration_deg_s2", config.acceleration_rad_s2, 1.0, 1000.0);
  config.limits = read_limits(table);
  config.servo = read_servo(table.table("servo"));
  config.history = read_angles(table.table("angles"));
  return config;
}

}  // namespace ols
