// The Military Grid Reference System: positions as they are spoken over the radio. Computed by
// GeographicLib (C. Karney).
#pragma once

#include <string>

#include "geometry/wgs84.h"

namespace ols {

// The name of the square that contains the position, by its south-western corner. With 0 digits:
// "33UXQ", a square of 100 km. With 5 digits: "33UXQ1643251958", a square of 1 m. Near the poles,
// the squares of the polar grid are used. Throws std::invalid_argument for an invalid latitude or
// longitude.
std::string mgrs(const Geodetic& position, int digits);

}  // namespace ols
