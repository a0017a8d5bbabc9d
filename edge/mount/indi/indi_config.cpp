#include "edge/mount/indi/indi_config.h"

#include <regex>
#include <stdexcept>

#include "edge/mount/driven/drive_config.h"

namespace ols::indi {

IndiConfig::IndiConfig() {
  drive.pan = drive.tilt = {0.0, 1.0, 1.0};
  drive.servo.gain_hz = 1.5;
  drive.servo.max_speed_rad_s = radians(4.0);
  drive.positions = {.delay_s = 0.1, .delay_sd_s = 0.05, .sd_rad = radians(0.005)};
}

namespace {

void check(ConfigTable& table, const IndiConfig& c) {
  mount::check_travel(table, c.drive.limits);
  const mount::Limits& limits = c.drive.limits;
  if (limits.pan_max_rad - limits.pan_min_rad > 2.0 * kPi)
    throw table.error("pan_max_deg", "the travel of pan is at most a full turn");
  if (table.has("device") && c.device.empty())
    throw table.error("device", "must name the telescope");
}

// The library would wait for a name to be resolved for ever.
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

}  // namespace

config::Section indi_section(IndiConfig& c) {
  std::vector<config::Row> rows = server_rows(c);
  for (auto& row : mount::drive_rows(c.drive)) rows.push_back(std::move(row));
  return {"mount", "", rows, {}, [&c](ConfigTable& table) { check(table, c); }};
}

}  // namespace ols::indi
