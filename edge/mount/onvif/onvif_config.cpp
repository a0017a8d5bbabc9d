#include "edge/mount/onvif/onvif_config.h"

#include <algorithm>
#include <iterator>

#include "edge/config/config_units.h"
#include "edge/device/certificate_key.h"
#include "edge/mount/driven/drive_config.h"
#include "edge/mount/onvif/service_address.h"

namespace ols::onvif {
namespace {

using config::number;
using station::in_degrees;

std::vector<config::Row> axis_rows(mount::AxisScale& scale, const std::string& axis) {
  return {
      number(axis + "_gain_deg", scale.per_unit_rad, {-720.0, 720.0}, in_degrees(),
             "Degrees of " + axis +
                 " per 1 of the camera's position: often 180 or 90; 1 if it reports degrees; "
                 "negative if it counts the other way.")
          .required(),
      number(axis + "_zero_deg", scale.zero_rad, {-360.0, 360.0}, in_degrees(),
             "Angle of " + axis + " at the camera's position 0."),
      number(
          axis + "_speed_deg_s", scale.speed_per_unit_rad, {-720.0, 720.0}, in_degrees("deg/s"),
          "Speed of " + axis + " at the camera's velocity 1; negative if it turns the other way.")
          .required()};
}

std::vector<config::Row> request_rows(OnvifConfig& c) {
  return {number("lease_s", c.drive.lease_s, {0.5, 10.0}, "s",
                 "Time-out that each motion is ordered with; it is renewed after a third of it."),
          number("timeout_s", c.timeout_s, {0.2, 30.0}, "s",
                 "A request without an answer for so long ends the connection.")};
}

void check(ConfigTable& table, const OnvifConfig& c) {
  if (c.user.empty() != c.password_file.empty())
    throw table.error(c.user.empty() ? "password_file" : "user",
                      "user and password_file need each other");
  const mount::DriveConfig& d = c.drive;
  mount::check_travel(table, d.limits);
  for (const auto& [key, value] : {std::pair{"pan_gain_deg", d.pan.per_unit_rad},
                                   {"tilt_gain_deg", d.tilt.per_unit_rad},
                                   {"pan_speed_deg_s", d.pan.speed_per_unit_rad},
                                   {"tilt_speed_deg_s", d.tilt.speed_per_unit_rad}}) {
    if (value == 0.0 && table.has(key)) throw table.error(key, "must not be 0");
  }
}

}  // namespace

config::Section onvif_section(OnvifConfig& c) {
  std::vector<config::Row> rows{
      config::text("url", c.url,
                   "Address of the camera's device service, without user and password: "
                   "http://HOST/onvif/device_service.",
                   check_address)
          .required(),
      config::text("user", c.user, "User name at the camera; empty: none."),
      config::text("password_file", c.password_file,
                   "File whose first line is that user's password; only the station may be able "
                   "to read it."),
      config::text("profile", c.profile,
                   "Token of the media profile to steer; empty: the first with PTZ."),
      config::text(
          "pinned_key", c.pinned_key,
          "Public key of an https camera whose certificate is its own: sha256// and the key's "
          "hash; empty: an authority that this system trusts must have signed it.",
          device::check_pinned_key)};
  for (auto more : {axis_rows(c.drive.pan, "pan"), axis_rows(c.drive.tilt, "tilt"),
                    mount::drive_rows(c.drive), request_rows(c)})
    std::ranges::move(more, std::back_inserter(rows));
  return {"mount", "", rows, {}, [&c](ConfigTable& table) { check(table, c); }};
}

}  // namespace ols::onvif
