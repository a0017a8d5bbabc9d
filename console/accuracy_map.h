// How well the site as it is now can know a position: the Cramer-Rao bound of one exposure of every
// station (geometry/precision.h), over a box of the map. Pure.
#pragma once

#include <optional>
#include <string>

#include "console/entity_table.h"

namespace ols::console {

inline constexpr int kAccuracyCells = 40;  // of each side

// Of the stations of the site's state, by the deviations that they state of position, heading and
// tilt, and one pixel of white noise; each is taken to look at the place. Silent ones do not count.
// "?box=WEST,SOUTH,EAST,NORTH&above=METRES" [deg; m above the stations' mean] -> {height_m,
// columns, rows, sd_m}: the root of the covariance's trace, from the north-west by rows; null where
// fewer than two stations determine the place. Nothing if it is not such a query.
std::optional<Json> accuracy_map(const Json& stations, const std::string& query);

}  // namespace ols::console
