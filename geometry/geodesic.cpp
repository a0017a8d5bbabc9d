#include "geometry/geodesic.h"

#include <GeographicLib/Geodesic.hpp>

#include "geometry/angles.h"

namespace ols {

Geodesic geodesic_between(const Geodetic& from, const Geodetic& to) {
  double distance_m = 0.0, azimuth_deg = 0.0, azimuth_there_deg = 0.0;
  GeographicLib::Geodesic::WGS84().Inverse(degrees(from.latitude_rad), degrees(from.longitude_rad),
                                           degrees(to.latitude_rad), degrees(to.longitude_rad),
                                           distance_m, azimuth_deg, azimuth_there_deg);
  return {distance_m, wrap_two_pi(radians(azimuth_deg))};
}

}  // namespace ols
