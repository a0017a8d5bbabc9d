// Geometry for the page's map, computed here so that the page needs no formulas of its own. Pure.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "console/entity_table.h"

namespace ols::console {

// The numbers after "NAME=" in a query, up to the next "&": separated by commas, at most four.
// Empty if there are no such numbers.
std::vector<double> numbers_of(std::string_view query, std::string_view name);

// The ellipse that holds the position with 95 % probability, from a horizontal covariance [m^2]
// (east-east, east-north, north-north): {semi_major_m, semi_minor_m, azimuth_deg of the major
// axis}; null if it is no covariance.
Json ellipse95(double ee, double en, double nn);

// "?from=LATITUDE,LONGITUDE&to=..." [deg] -> {distance_m, azimuth_deg} on the ellipsoid; nullopt
// for any other query.
std::optional<Json> measure(const std::string& query);

// "?box=WEST,SOUTH,EAST,NORTH" [deg] -> {zone, step_m, lines: [{label, path: [[longitude,
// latitude], ...]}]}: the lines of the UTM grid in the zone of the box's centre, at most a few
// dozen. nullopt if the query has no box, or the box is wider than a zone or too near to a pole.
std::optional<Json> utm_grid(const std::string& query);

}  // namespace ols::console
