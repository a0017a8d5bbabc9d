#include "edge/mount/serial/serial_config.h"

#include <utility>

#include "edge/config/config_units.h"
#include "edge/mount/driven/drive_config.h"

namespace ols::serial_mount {

using config::number;
using station::in_degrees;

SerialConfig::SerialConfig() {
  drive.servo.gain_hz = 1.0;
  drive.positions = {.delay_s = 0.05, .delay_sd_s = 0.05, .sd_rad = radians(0.1)};
}

namespace {

std::vector<config::Row> axis_rows(mount::AxisScale& scale, const std::string& axis,
                                   Language language) {
  auto gain = number(axis + "_gain_deg", scale.per_unit_rad, {-10.0, 10.0}, in_degrees(),
                     language == Language::kPelcoD
                         ? "1 or -1: degrees of " + axis + " per degree that the head reports."
                         : "Degrees of " + axis + " per count of the head's position.");
  return {std::move(gain).required(),
          number(axis + "_zero_deg", scale.zero_rad, {-360.0, 360.0}, in_degrees(),
                 "Angle of " + axis + " at the head's position 0."),
          number(axis + "_speed_deg_s", scale.speed_per_unit_rad, {0.1, 720.0}, in_degrees("deg/s"),
                 "Speed of " + axis + " at the head's greatest speed.")
              .required()};
}

std::vector<config::Row> line_rows(SerialConfig& c, Language language) {
  std::vector<config::Row> rows{
      config::text("device", c.device, "Serial device: a path in /dev/serial/by-id stays the same.")
          .required(),
      config::one_of("baud", c.baud, {2400, 4800, 9600, 19200, 38400}, "", "Rate of the line.")};
  if (language == Language::kPelcoD)
    rows.push_back(
        config::integer("address", c.address, 1, 255, "", "Address of the head on the line."));
  rows.push_back(number("timeout_s", c.timeout_s, {0.05, 5.0}, "s",
                        "A question without an answer for so long is asked again."));
  return rows;
}

void check(ConfigTable& table, const SerialConfig& c) {
  const mount::DriveConfig& d = c.drive;
  mount::check_travel(table, d.limits);
  for (const auto& [key, value] :
       {std::pair{"pan_gain_deg", d.pan.per_unit_rad}, {"tilt_gain_deg", d.tilt.per_unit_rad}})
    if (table.has(key) && value == 0.0) throw table.error(key, "must not be 0");
}

}  // namespace

config::Section serial_section(SerialConfig& c, Language language) {
  std::vector<config::Row> rows = line_rows(c, language);
  for (auto more : {axis_rows(c.drive.pan, "pan", language),
                    axis_rows(c.drive.tilt, "tilt", language), mount::drive_rows(c.drive)})
    for (auto& row : more) rows.push_back(std::move(row));
  return {"mount", "", rows, {}, [&c](ConfigTable& table) { check(table, c); }};
}

}  // namespace ols::serial_mount
