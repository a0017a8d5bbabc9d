// Reads the scenery that `ols-calibrate scenery` has measured as coverings of the land.
#pragma once

#include <string>

#include "tools/land/covering_reader.h"
#include "tools/land/elevation_reader.h"

namespace ols::land {

// The points within the bounds. Each becomes a square, 0.1 degrees wide as seen from the station
// that measured it. Throws CsvError.
ReadCoverings read_scenery_coverings(const std::string& path, const Bounds& bounds);

}  // namespace ols::land
