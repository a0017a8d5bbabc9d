// The PTU's part of a station's configuration file, in degrees there.
//
//   [ptu]
//   device = "/dev/ttyUSB0"      # required
//   baud = 38400                 # to be used
//   line_baud = 9600             # at which a unit may answer that was just switched on
//   poll_interval_s = 0.025      # no shorter than the baud carries: edge/ptu/budget.h
//   reply_timeout_s = 0.5
//   acceleration_deg_s2 = 57.3
//   pan_min_deg = -159           # narrows what the unit reports
//   pan_max_deg = 159
//   tilt_min_deg = -47
//   tilt_max_deg = 31
//   homes_at_power_up = true     # the unit's own setting
//   rehome = "never"             # or "when-unreferenced": homing sweeps the whole travel
//   home_despite_keep_out = false  # an operator may home a unit that has regions to keep out of
//   step_mode = "keep"           # E-series: half, quarter, eighth, auto
//   hold_power = "keep"          # regular, low, off (off loses the position)
//   move_power = "keep"          # high, regular, low
//   environment_interval_s = 5   # supply voltage and temperatures; 0: never
//   supply_min_V = 11.5          # an alarm below
//   [[ptu.keep_out]]             # as many as there are, up to 12; in the unit's own angles
//   pan_min_deg = 20
//   pan_max_deg = 40
//   tilt_min_deg = -47
//   tilt_max_deg = 5
//   [ptu.servo]
//   gain_hz = 3                  # 1/s
//   look_ahead_s = 0.3           # with v/a at most 1 s at 20 deg/s: it runs on so long on its own
//   max_speed_deg_s = 57
//   goal_timeout_s = 0.5
//   [ptu.angles]
//   span_s = 5
//   max_gap_s = 0.25
//   max_extrapolation_s = 0.15
//   acceleration_sd_deg_s2 = 2.3 # default: 0.04 of acceleration_deg_s2
#pragma once

#include "base/toml_config.h"
#include "edge/ptu/driver.h"

namespace ols {

// `table` is [ptu]. Throws ConfigError.
PtuConfig read_ptu_config(ConfigTable& table);

}  // namespace ols
