#include "geometry/mgrs.h"

#include <GeographicLib/MGRS.hpp>
#include <GeographicLib/UTMUPS.hpp>
#include <cmath>
#include <stdexcept>

#include "geometry/angles.h"

namespace ols {

std::string mgrs(const Geodetic& position, int digits) {
  const double latitude_deg = degrees(position.latitude_rad);
  const double longitude_deg = degrees(position.longitude_rad);
  if (!std::isfinite(latitude_deg) || !std::isfinite(longitude_deg)) {
    throw std::invalid_argument("no latitude or longitude");
  }
  try {
    int zone = 0;
    bool northern = true;
    double x_m = 0.0, y_m = 0.0;
    GeographicLib::UTMUPS::Forward(latitude_deg, longitude_deg, zone, northern, x_m, y_m);
    std::string name;
    GeographicLib::MGRS::Forward(zone, northern, x_m, y_m, latitude_deg, digits, name);
    return name;
  } catch (const GeographicLib::GeographicErr& problem) {
    throw std::invalid_argument(problem.what());
  }
}

}  // namespace ols
