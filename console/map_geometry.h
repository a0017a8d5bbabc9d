// Geometry for the map on the page, computed here so that the page needs no formulas of its own.
// Pure.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "console/entity_table.h"

namespace ols::console {

// Reads numbers from a query: at most four, separated by commas, between `name` (which includes the
// "=") and the next "&". Empty if there are no such numbers, or more than four.
std::vector<double> numbers_of(std::string_view query, std::string_view name);

// The ellipse that contains the position with a probability of 95 %, from a horizontal covariance
// [m^2] (east-east, east-north, north-north). Returns {semi_major_m, semi_minor_m, azimuth_deg of
// the major axis}; null if the numbers are not a valid covariance.
Json ellipse95(double ee, double en, double nn);

// Distance and azimuth on the ellipsoid: for "?from=LATITUDE,LONGITUDE&to=LATITUDE,LONGITUDE"
// [deg], returns {distance_m, azimuth_deg, mgrs}, where mgrs is the MGRS reference of `to`; nullopt
// for any other query.
std::optional<Json> measure(const std::string& query);

// The lines of the UTM grid in a box, in the zone of the box's centre, at most a few dozen: for
// "?box=WEST,SOUTH,EAST,NORTH" [deg], returns {zone, step_m, lines: [{label, path: [[longitude,
// latitude], ...]}]}. nullopt if the query has no box, or if the box is wider than a zone or too
// near to a pole.
std::optional<Json> utm_grid(const std::string& query);

}  // namespace ols::console
