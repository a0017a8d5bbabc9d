// The keys of [mount] that every mount with a Drive has. Pure.
#pragma once

#include <vector>

#include "base/config/config_section.h"
#include "edge/mount/onvif/drive.h"

namespace ols::onvif {

// Travel, speed, the interval of positions, their age and their error. The defaults are the present
// values of `config`.
std::vector<config::Row> drive_rows(DriveConfig& config);
// Throws ConfigError for a travel that is empty.
void check_travel(ConfigTable& table, const mount::Limits& limits);

}  // namespace ols::onvif
