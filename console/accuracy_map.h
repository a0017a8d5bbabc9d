// How accurately the present site can know a position, over a box of the map: the Cramer-Rao bound
// of one exposure of every station (geometry/precision.h). Pure.
#pragma once

#include <optional>
#include <string>

#include "console/entity_table.h"

namespace ols::console {

inline constexpr int kAccuracyCells = 40;  // of each side

// From the stations of the site's state: their stated deviations of position, heading and tilt, and
// one pixel of white noise. Each is assumed to look at the place. Silent ones do not count.
// "?box=WEST,SOUTH,EAST,NORTH&above=METRES" [deg; m above the stations' mean] -> {height_m,
// columns, rows, sd_m}: the root of the covariance's trace, by rows from the north-west; null where
// fewer than two stations determine the place. nullopt if it is no such query.
std::optional<Json> accuracy_map(const Json& stations, const std::string& query);

}  // namespace ols::console
