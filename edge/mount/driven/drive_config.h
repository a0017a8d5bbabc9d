// The keys of [mount] that all kinds of mounts with a Drive have. Pure.
#pragma once

#include <vector>

#include "base/config/config_section.h"
#include "edge/mount/driven/drive.h"

namespace ols::mount {

// Keys for travel, gain, speed and polling interval, and for age and error of the positions. Their
// defaults are the present values in `config`.
std::vector<config::Row> drive_rows(DriveConfig& config);
// Throws ConfigError if a travel is empty (minimum not below maximum).
void check_travel(ConfigTable& table, const Limits& limits);

}  // namespace ols::mount
