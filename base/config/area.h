// An area of latitude and longitude. Pure.
#pragma once

#include <array>

namespace ols {

// South, west, north, east [deg]. If west is greater than east, the area crosses the date line.
using Area = std::array<double, 4>;

inline bool spans_longitude(const Area& area_deg, double longitude_deg) {
  const double west = area_deg[1], east = area_deg[3];
  return west <= east ? longitude_deg >= west && longitude_deg <= east
                      : longitude_deg >= west || longitude_deg <= east;
}

inline bool is_inside(const Area& area_deg, double latitude_deg, double longitude_deg) {
  return latitude_deg >= area_deg[0] && latitude_deg <= area_deg[2] &&
         spans_longitude(area_deg, longitude_deg);
}

}  // namespace ols
