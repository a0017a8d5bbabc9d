// Degrees in a configuration file, radians in the field.
#pragma once

#include "base/config/config_section.h"
#include "geometry/angles.h"

namespace ols::station {

inline config::Unit in_degrees(const char* name = "deg") { return {name, radians, degrees}; }

}  // namespace ols::station
