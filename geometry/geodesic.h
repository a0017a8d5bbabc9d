// The shortest line between two places on the ellipsoid. Computed by GeographicLib (C. Karney).
#pragma once

#include "geometry/wgs84.h"

namespace ols {

struct Geodesic {
  double distance_m = 0.0;   // along the ellipsoid; ignores heights
  double azimuth_rad = 0.0;  // at `from`, clockwise from true north, 0..2 pi
};

Geodesic geodesic_between(const Geodetic& from, const Geodetic& to);

}  // namespace ols
