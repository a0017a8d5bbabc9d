// Reads two parts of a scenario: the landmarks, in UTM as in a land register, and how the stations
// find their headings.
#pragma once

#include <vector>

#include "base/config/config_section.h"
#include "geometry/utm.h"
#include "sim/scenario/scenario.h"

namespace ols::sim {

inline constexpr double kFar_m = 1e6;  // limit of coordinates: a site is never larger than this

struct UtmPlace {
  Utm utm{.zone = 0};
  double height_m = 0.0;
};

std::vector<config::Row> utm_rows(UtmPlace& place);
// Throws ConfigError for a place outside its UTM zone.
Geodetic geodetic(ConfigTable& table, const UtmPlace& place);

config::Section stationing_section(StationingScenario& stationing);

}  // namespace ols::sim
