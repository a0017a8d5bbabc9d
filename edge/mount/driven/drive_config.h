// The keys of [mount] that every mount with a Drive has. Pure.
#pragma once

#include <vector>

#include "base/config/config_section.h"
#include "edge/mount/driven/drive.h"

namespace ols::mount {

// Travel, speed, the interval of positions, their age and their error. The defaults are the present
// values of `config`.
std::vector<config::Row> drive_rows(DriveConfig& config);
// Throws ConfigError for a travel that is empty.
void check_travel(ConfigTable& table, const Limits& limits);

}  // namespace ols::mount
