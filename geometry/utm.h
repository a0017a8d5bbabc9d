// Universal Transverse Mercator: the coordinates that land registers and surveyors use. Computed by
// GeographicLib (C. Karney).
//
// Grid north is not true north: a grid bearing plus the convergence is the true azimuth. A grid
// distance is the true distance times the scale. Heights in land registers are usually above mean
// sea level; heights here are above the ellipsoid, as everywhere in this project.
#pragma once

#include "geometry/wgs84.h"

namespace ols {

struct Utm {
  int zone = 0;  // 1..60
  bool northern = true;
  double easting_m = 0.0;   // with the false easting of 500 km
  double northing_m = 0.0;  // with the false northing of 10 000 km in the south
};

struct UtmPoint {
  Utm position;
  double convergence_rad = 0.0;  // direction of grid north, clockwise from true north
  double scale = 1.0;            // grid distance over true distance on the ellipsoid
};

// Throws std::invalid_argument with the reason if the zone does not exist, or if the coordinates
// are outside the zone.
Geodetic geodetic_from_utm(const Utm& position, double height_m);

// Uses the standard zone of the position. Throws std::invalid_argument near the poles, where there
// is no zone.
UtmPoint utm_from_geodetic(const Geodetic& position);

}  // namespace ols
