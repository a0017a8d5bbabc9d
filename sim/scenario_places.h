// The places of a scenario that are given in UTM, as a land register has them: landmarks, and how
// the stations find their headings by sighting them.
#pragma once

#include <string>

#include "base/toml_config.h"
#include "geometry/wgs84.h"
#include "sim/scenario.h"

namespace ols::sim {

// zone, hemisphere, easting_m, northing_m, height_m. ConfigError for a place outside its zone.
Geodetic read_utm_place(ConfigTable& table);

StationingScenario read_stationing(ConfigTable& table);

}  // namespace ols::sim
