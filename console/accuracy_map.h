// A map of the accuracy with which the site can now determine a position, for a box on the map. It
// is the Cramer-Rao bound for one exposure of every station (geometry/precision.h). Pure.
#pragma once

#include <optional>
#include <string>

#include "console/entity_table.h"

namespace ols::console {

inline constexpr int kAccuracyCells = 40;  // number of cells along each side of the box

// `stations`: the stations of the site's state. Their errors are the 1-sigmas of position, heading
// and tilt that they state, and one pixel of white noise. Each station is assumed to look at the
// place. Silent stations are left out. `query`: "?box=WEST,SOUTH,EAST,NORTH&above=METRES" [deg; m
// above the stations' mean height]; nullopt for any other query. Returns {height_m, columns, rows,
// sd_m}. sd_m is the square root of the covariance's trace, for each cell, row by row from the
// north-west corner; null if fewer than two stations determine the place.
std::optional<Json> accuracy_map(const Json& stations, const std::string& query);

}  // namespace ols::console
