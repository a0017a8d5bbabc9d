// The PTU's part of a station's configuration file, in degrees there.
//
//   [ptu]
//   device = "/dev/ttyUSB0"      # required
//   baud = 38400
//   poll_interval_s = 0.025
//   reply_timeout_s = 0.5
//   acceleration_deg_s2 = 60
//   pan_min_deg = -159           # narrows what the unit reports
//   pan_max_deg = 159
//   tilt_min_deg = -47
//   tilt_max_deg = 31
//   [ptu.servo]
//   gain_hz = 3                  # 1/s
//   look_ahead_s = 0.3
//   max_speed_deg_s = 57
//   goal_timeout_s = 0.5
//   [ptu.angles]
//   span_s = 5
//   max_gap_s = 0.25
//   max_extrapolation_s = 0.15
//   acceleration_sd_deg_s2 = 11
#pragma once

#include "base/toml_config.h"
#include "edge/ptu/driver.h"

namespace ols {

// `table` is [ptu]. Throws ConfigError.
PtuConfig read_ptu_config(ConfigTable& table);

}  // namespace ols
