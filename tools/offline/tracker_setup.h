// The tracker's parameters, from the command line and a file.
#pragma once

#include <string>

#include "edge/tracker/tracker_config.h"

namespace ols::offline {

// From the table [tracker] of a TOML file, or the defaults if `path` is empty. `mode` ("paper" or
// "full") overrides the file's; empty: the file's. Throws ConfigError.
tracker::TrackerConfig load_tracker_config(const std::string& path, const std::string& mode);

}  // namespace ols::offline
