// The Military Grid Reference System: places as people say them over the radio. The arithmetic is
// GeographicLib's (C. Karney).
#pragma once

#include <string>

#include "geometry/wgs84.h"

namespace ols {

// "33UXQ" with 0 digits, the square of 100 km; "33UXQ1643251958" with 5, of 1 m: the south-western
// corner of the square that holds the place. Near the poles in the polar squares.
// std::invalid_argument for what is no latitude or longitude.
std::string mgrs(const Geodetic& position, int digits);

}  // namespace ols
