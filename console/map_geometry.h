// What the page draws and measures on its map, computed where all other geometry is. Pure.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "console/entity_table.h"

namespace ols::console {

// The numbers of a query after "NAME=" up to the next "&", separated by commas, four at most; empty
// if there are others.
std::vector<double> numbers_of(std::string_view query, std::string_view name);

// Of a horizontal covariance [m^2] east-east, east-north, north-north: the ellipse that holds the
// position with 95 % probability. {semi_major_m, semi_minor_m, azimuth_deg of the major axis}; null
// for what is no covariance.
Json ellipse95(double ee, double en, double nn);

// "?from=LATITUDE,LONGITUDE&to=..." [deg] -> {distance_m, azimuth_deg} on the ellipsoid; nothing if
// it is not that.
std::optional<Json> measure(const std::string& query);

// "?box=WEST,SOUTH,EAST,NORTH" [deg] -> {zone, step_m, lines: [{label, path: [[longitude,
// latitude], ...]}]}: the lines of the UTM grid of the box's middle, at most a few dozen; nothing
// if it is no box, is wider than a zone, or too near to a pole.
std::optional<Json> utm_grid(const std::string& query);

}  // namespace ols::console
