#include "geometry/utm.h"

#include <GeographicLib/UTMUPS.hpp>
#include <stdexcept>

#include "geometry/angles.h"

namespace ols {

Geodetic geodetic_from_utm(const Utm& position, double height_m) {
  if (position.zone < 1 || position.zone > 60) {
    throw std::invalid_argument("UTM zone must be 1 to 60");
  }
  try {
    double latitude_deg = 0.0, longitude_deg = 0.0;
    GeographicLib::UTMUPS::Reverse(position.zone, position.northern, position.easting_m,
                                   position.northing_m, latitude_deg, longitude_deg);
    return {radians(latitude_deg), radians(longitude_deg), height_m};
  } catch (const GeographicLib::GeographicErr& problem) {
    throw std::invalid_argument(problem.what());
  }
}

UtmPoint utm_from_geodetic(const Geodetic& position) {
  UtmPoint point;
  try {
    double convergence_deg = 0.0;
    GeographicLib::UTMUPS::Forward(degrees(position.latitude_rad), degrees(position.longitude_rad),
                                   point.position.zone, point.position.northern,
                                   point.position.easting_m, point.position.northing_m,
                                   convergence_deg, point.scale);
    point.convergence_rad = radians(convergence_deg);
  } catch (const GeographicLib::GeographicErr& problem) {
    throw std::invalid_argument(problem.what());
  }
  if (point.position.zone == GeographicLib::UTMUPS::UPS) {
    throw std::invalid_argument("there is no UTM zone near the poles");
  }
  return point;
}

}  // namespace ols
