#include "edge/mount/indi/indi_config.h"

#include <regex>
#include <stdexcept>

#include "edge/config/config_units.h"

namespace ols::indi {

using config::number;
using station::in_degrees;

IndiConfig::IndiConfig() {
  drive.pan = drive.tilt = {0.0, 1.0, 1.0};
  drive.servo.gain_hz = 1.5;
  drive.servo.max_speed_rad_s = radians(4.0);
  drive.positions = {.delay_s = 0.1, .delay_sd_s = 0.05, .sd_rad = radians(0.005)};
}

namespace {

void check(ConfigTable& table, const IndiConfig& c) {
  const mount::Limits& limits = c.drive.limits;
  if (limits.pan_min_rad >= limits.pan_max_rad)
    throw table.error("pan_max_deg", "must be greater than pan_min_deg");
  if (limits.tilt_min_rad >= limits.tilt_max_rad)
    throw table.error("tilt_max_deg", "must be greater than tilt_min_deg");
  if (limits.pan_max_rad - limits.pan_min_rad > 2.0 * kPi)
    throw table.error("pan_max_deg", "the travel of pan is at most a full turn");
  if (c.device.empty()) throw table.error("device", "must name the telescope");
}

// The library waits for a name for ever.
void check_host(const std::string& host) {
  static const std::regex kAddress(R"([0-9]{1,3}(\.[0-9]{1,3}){3})");
  if (host != "localhost" && !std::regex_match(host, kAddress))
    throw std::invalid_argument("must be localhost or an IPv4 address");
}

std::vector<config::Row> server_rows(IndiConfig& c) {
  return {
      config::text("host", c.host, "The INDI server: localhost or an IPv4 address.", check_host),
      config::integer("port", c.port, 1, 65535, "", "Its port."),
      config::text("device", c.device,
                   "The telescope's name at the server; `indi_getprop` lists them.")
          .required(),
      config::word("axes", c.axes,
                   {{"equatorial", Axes::kEquatorial}, {"altazimuth", Axes::kAltAzimuth}},
                   "equatorial: pan is minus the hour angle, tilt is the declination; "
                   "altazimuth: pan is minus the azimuth, tilt is the elevation."),
      config::word("pier_side", c.pier_side,
                   {{"first", ""}, {"west", "PIER_WEST"}, {"east", "PIER_EAST"}},
                   "The side of the pier that the calibration is for; first: where the "
                   "telescope is when the station starts.")};
}

std::vector<config::Row> motion_rows(IndiConfig& c) {
  onvif::DriveConfig& d = c.drive;
  mount::Limits& l = d.limits;
  return {
      number("pan_min_deg", l.pan_min_rad, {-360.0, 360.0}, in_degrees(),
             "Narrows the travel; a German mount must not reach its change of side."),
      number("pan_max_deg", l.pan_max_rad, {-360.0, 360.0}, in_degrees(), "The same."),
      number("tilt_min_deg", l.tilt_min_rad, {-90.0, 90.0}, in_degrees(), "Narrows the travel."),
      number("tilt_max_deg", l.tilt_max_rad, {-90.0, 90.0}, in_degrees(), "Narrows the travel."),
      number("gain_hz", d.servo.gain_hz, {0.1, 5.0}, "1/s",
             "Proportional gain on the angle error."),
      number("max_speed_deg_s", d.servo.max_speed_rad_s, {0.01, 30.0}, in_degrees("deg/s"),
             "Maximum speed of each axis; the telescope's own limit may be lower."),
      number("report_interval_s", d.poll_s, {0.02, 2.0}, "s",
             "Interval of the telescope's reports, as it is asked for."),
      number("delay_s", d.positions.delay_s, {0.0, 5.0}, "s", "Age of a position when it arrives."),
      number("delay_sd_s", d.positions.delay_sd_s, {1e-3, 5.0}, "s", "1-sigma of delay_s."),
      number("position_sd_deg", d.positions.sd_rad, {1e-5, 10.0}, in_degrees(),
             "1-sigma of a reported position.")};
}

}  // namespace

config::Section indi_section(IndiConfig& c) {
  std::vector<config::Row> rows = server_rows(c);
  for (auto& row : motion_rows(c)) rows.push_back(std::move(row));
  return {"mount", "", rows, {}, [&c](ConfigTable& table) { check(table, c); }};
}

}  // namespace ols::indi
