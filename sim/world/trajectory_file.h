// Reads a trajectory from a CSV file with the columns `utime_us,lat,lon,h` (degrees, ellipsoidal
// metres).
#pragma once

#include <memory>
#include <string>

#include "geometry/wgs84.h"
#include "sim/world/trajectory.h"

namespace ols::sim {

// The first row is at scenario time 0. Throws ConfigError with file, line and reason.
std::unique_ptr<Trajectory> load_trajectory_file(const std::string& path, const LocalFrame& site);

}  // namespace ols::sim
