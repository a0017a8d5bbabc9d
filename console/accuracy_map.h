// How accurately the site can determine a position now, over a box of the map: the Cramer-Rao bound
// of one exposure of every station (geometry/precision.h). Pure.
#pragma once

#include <optional>
#include <string>

#include "console/entity_table.h"

namespace ols::console {

inline constexpr int kAccuracyCells = 40;  // along each side

// `stations`: from the site's state, with the stated deviations of their position, heading and
// tilt. One pixel of white noise is added, and each station is assumed to look at the place. Silent
// stations are left out.
// The query is "?box=WEST,SOUTH,EAST,NORTH&above=METRES" [deg; m above the stations' mean]; nullopt
// for any other query. The answer is {height_m, columns, rows, sd_m}. sd_m is the root of the
// covariance's trace, by rows from the north-west; null where fewer than two stations determine the
// place.
std::optional<Json> accuracy_map(const Json& stations, const std::string& query);

}  // namespace ols::console
