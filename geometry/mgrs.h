// The Military Grid Reference System: positions as spoken over the radio. By GeographicLib (C.
// Karney).
#pragma once

#include <string>

#include "geometry/wgs84.h"

namespace ols {

// The south-western corner of the square that holds the position. 0 digits: "33UXQ", a square of
// 100 km. 5 digits: "33UXQ1643251958", a square of 1 m. Near the poles the squares of the polar
// grid are used. Throws std::invalid_argument for an invalid latitude or longitude.
std::string mgrs(const Geodetic& position, int digits);

}  // namespace ols
