#include <array>
#include <utility>

#include "edge/sensors/gnss.h"
#include "edge/sensors/inclinometer.h"
#include "geometry/angles.h"

namespace ols {

namespace {

int sign(ConfigTable& table, const char* key, int fallback) {
  const auto value = table.integer(key, fallback, -1, 1);
  if (value == 0) throw table.error(key, "must be 1 or -1");
  return static_cast<int>(value);
}

double angle(ConfigTable& table, const char* key_deg, double fallback_rad, double least_deg,
             double greatest_deg) {
  return radians(table.number(key_deg, degrees(fallback_rad), least_deg, greatest_deg));
}

int baud_rate(ConfigTable& table, int fallback) {
  const auto baud = table.integer("baud", fallback, 600, 115200);
  for (const int known : {600, 1200, 2400, 4800, 9600, 19200, 38400, 57600, 115200}) {
    if (baud == known) return known;
  }
  throw table.error("baud", "is no rate of a serial line");
}

GnssFix least_fix(ConfigTable& table) {
  const std::string name =
      table.choice("least_fix", "3d", {"3d", "differential", "rtk-float", "rtk-fixed"});
  if (name == "differential") return GnssFix::kDifferential;
  if (name == "rtk-float") return GnssFix::kRtkFloat;
  if (name == "rtk-fixed") return GnssFix::kRtkFixed;
  return GnssFix::k3D;
}

}  // namespace

InclinometerConfig read_inclinometer_config(ConfigTable& table) {
  InclinometerConfig c;
  c.device = table.text("device", c.device);
  c.baud = baud_rate(table, c.baud);
  c.even_parity = table.choice("parity", "none", {"none", "even"}) == "even";
  c.stale_s = table.number("stale_s", c.stale_s, 0.2, 600.0);
  c.stuck_s = table.number("stuck_s", c.stuck_s, 1.0, 86400.0);
  c.swap_axes = table.boolean("swap_axes", c.swap_axes);
  c.x_sign = sign(table, "x_sign", c.x_sign);
  c.y_sign = sign(table, "y_sign", c.y_sign);
  c.x_zero_rad = angle(table, "x_zero_deg", c.x_zero_rad, -30.0, 30.0);
  c.y_zero_rad = angle(table, "y_zero_deg", c.y_zero_rad, -30.0, 30.0);
  c.range_rad = angle(table, "range_deg", c.range_rad, 0.1, 80.0);
  c.sd_rad = angle(table, "sd_deg", c.sd_rad, 1e-4, 10.0);
  return c;
}

GnssConfig read_gnss_config(ConfigTable& table) {
  GnssConfig c;
  c.host = table.text("host", c.host);
  c.port = std::to_string(table.integer("port", 2947, 1, 65535));
  c.stale_s = table.number("stale_s", c.stale_s, 0.5, 600.0);
  c.least_fix = least_fix(table);
  const auto antenna = table.numbers("ground_to_antenna_enu_m", {0.0, 0.0, 0.0}, -100.0, 100.0);
  c.ground_to_antenna_enu_m = {antenna[0], antenna[1], antenna[2]};
  c.sd_floor_m = table.number("sd_floor_m", c.sd_floor_m, 1e-4, 100.0);
  c.error_sigmas = table.number("error_sigmas", c.error_sigmas, 0.5, 3.0);
  c.accept_move_s = table.number("accept_move_s", c.accept_move_s, 0.0, 86400.0);
  return c;
}

}  // namespace ols
