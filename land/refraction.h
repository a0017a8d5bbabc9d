// Terrestrial refraction: how the air bends a line of sight over land.
#pragma once

#include "geometry/direction.h"

namespace ols::land {

// Light bends towards the earth: over a distance d, the light falls below the straight line by
// refraction_k d^2 / 2 R, where R is the radius of the earth. (The earth's surface falls below the
// straight line by d^2 / 2 R.) Over land in daylight, refraction_k is about 0.13, with a 1-sigma of
// 0.1; at 6 km, this 1-sigma is 0.3 m of height.
inline constexpr double kRefraction = 0.13, kRefractionSd = 0.1;

// The amount that refraction adds to the tangent of an elevation, for a point at this distance.
inline double refraction_slope(double refraction_k, double distance_m) {
  constexpr double kEarth_m = 6'371'000.0;
  return refraction_k * distance_m / (2.0 * kEarth_m);
}

// The direction of the straight line to a point at this range, and the reverse. Apparent directions
// are lifted by kRefraction.
inline AzimuthElevation straight(AzimuthElevation apparent, double range_m) {
  apparent.elevation_rad -= refraction_slope(kRefraction, range_m);
  return apparent;
}
inline AzimuthElevation apparent(AzimuthElevation straight, double range_m) {
  straight.elevation_rad += refraction_slope(kRefraction, range_m);
  return straight;
}

}  // namespace ols::land
