// Reads the file that describes a workshop's rectification targets.
#pragma once

#include <string>

#include "calibration/procedure/target_reader.h"

namespace ols::calibration {

// Throws ConfigError naming file, line and key.
RectificationTargets read_targets(const std::string& path);

}  // namespace ols::calibration
