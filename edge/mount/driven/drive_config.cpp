#include "edge/mount/driven/drive_config.h"

#include "edge/config/config_units.h"

namespace ols::mount {

using config::number;
using station::in_degrees;

std::vector<config::Row> drive_rows(DriveConfig& d) {
  Limits& l = d.limits;
  return {
      number("pan_min_deg", l.pan_min_rad, {-720.0, 720.0}, in_degrees(), "Narrows the travel."),
      number("pan_max_deg", l.pan_max_rad, {-720.0, 720.0}, in_degrees(), "Narrows the travel."),
      number("tilt_min_deg", l.tilt_min_rad, {-180.0, 180.0}, in_degrees(), "Narrows the travel."),
      number("tilt_max_deg", l.tilt_max_rad, {-180.0, 180.0}, in_degrees(), "Narrows the travel."),
      number("gain_hz", d.servo.gain_hz, {0.1, 5.0}, "1/s",
             "Proportional gain on the angle error; a mount that answers late needs a small one."),
      number("max_speed_deg_s", d.servo.max_speed_rad_s, {0.01, 360.0}, in_degrees("deg/s"),
             "Maximum speed of each axis."),
      number("poll_interval_s", d.poll_s, {0.02, 2.0}, "s", "Interval of the positions."),
      number("delay_s", d.positions.delay_s, {0.0, 5.0}, "s", "Age of a position when it arrives."),
      number("delay_sd_s", d.positions.delay_sd_s, {1e-3, 5.0}, "s", "1-sigma of delay_s."),
      number("position_sd_deg", d.positions.sd_rad, {1e-5, 10.0}, in_degrees(),
             "1-sigma of a reported position; repeatability of cheap mounts is 0.05 to 0.25 deg.")};
}

void check_travel(ConfigTable& table, const Limits& limits) {
  if (limits.pan_min_rad >= limits.pan_max_rad)
    throw table.error("pan_max_deg", "must be greater than pan_min_deg");
  if (limits.tilt_min_rad >= limits.tilt_max_rad)
    throw table.error("tilt_max_deg", "must be greater than tilt_min_deg");
}

}  // namespace ols::mount
