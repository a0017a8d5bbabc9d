// The keys of [inclinometer] and [gnss] that every kind has.
#include "edge/config/config_units.h"
#include "edge/sensors/gnss.h"
#include "edge/sensors/inclinometer.h"

namespace ols::sensors {

std::vector<config::Row> inclinometer_rows(InclinometerConfig& c) {
  return {config::number("stale_s", c.stale_s, {0.2, 600.0}, "s",
                         "Without a good reading for this long, the sensor has a fault."),
          config::number("stuck_s", c.stuck_s, {1.0, 86400.0}, "s",
                         "Without any change of a digit for this long, the sensor is stuck."),
          config::flag("swap_axes", c.swap_axes, "Whether the sensor's X lies along ORIGIN's Y."),
          config::one_of("x_sign", c.x_sign, {1, -1}, "",
                         "Sign of the X axis, after swapping and zero."),
          config::one_of("y_sign", c.y_sign, {1, -1}, "",
                         "Sign of the Y axis, after swapping and zero."),
          config::number("x_zero_deg", c.x_zero_rad, {-30.0, 30.0}, station::in_degrees(),
                         "Reading of the X axis, after swapping, when ORIGIN is level."),
          config::number("y_zero_deg", c.y_zero_rad, {-30.0, 30.0}, station::in_degrees(),
                         "Reading of the Y axis, after swapping, when ORIGIN is level."),
          config::number("range_deg", c.range_rad, {0.1, 80.0}, station::in_degrees(),
                         "Readings beyond are refused."),
          config::number("sd_deg", c.sd_rad, {1e-4, 10.0}, station::in_degrees(),
                         "1-sigma of zero and mounting; averaging does not reduce it.")};
}

std::vector<config::Row> gnss_rows(GnssConfig& c) {
  return {config::number("stale_s", c.stale_s, {0.5, 600.0}, "s",
                         "Without a report for this long, the receiver has a fault."),
          config::word("least_fix", c.least_fix,
                       {{"3d", GnssFix::k3D},
                        {"differential", GnssFix::kDifferential},
                        {"rtk-float", GnssFix::kRtkFloat},
                        {"rtk-fixed", GnssFix::kRtkFixed}},
                       "Worse fixes are not used."),
          config::numbers("ground_to_antenna_enu_m", {c.ground_to_antenna_enu_m.data(), 3},
                          {-100.0, 100.0}, "m", "Antenna from GROUND: east, north, up."),
          config::number("sd_floor_m", c.sd_floor_m, {1e-4, 100.0}, "m",
                         "Minimum that a stated 1-sigma is taken for."),
          config::number("accept_move_s", c.accept_move_s, {0.0, 86400.0}, "s",
                         "A new position is adopted when it holds for this long; 0: never.")};
}

}  // namespace ols::sensors
