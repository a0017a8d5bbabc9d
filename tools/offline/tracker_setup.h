// The tracker's parameters as a program is given them.
#pragma once

#include <string>

#include "edge/tracker/tracker_config.h"

namespace ols {

// Of the table [tracker] of a TOML file; the defaults when `path` is empty. `mode`, "paper" or
// "full", goes before the file's; empty leaves that. Throws ConfigError.
TrackerConfig load_tracker_config(const std::string& path, const std::string& mode);

}  // namespace ols
