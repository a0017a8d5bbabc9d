// Reads the tracker's parameters from the command line and a file.
#pragma once

#include <string>

#include "edge/tracker/tracker_config.h"

namespace ols::offline {

// Reads the table [tracker] of a TOML file; if `path` is empty, returns the defaults. `mode`
// ("paper" or "full") replaces the file's mode; empty: keeps it. Throws ConfigError.
tracker::TrackerConfig load_tracker_config(const std::string& path, const std::string& mode);

}  // namespace ols::offline
