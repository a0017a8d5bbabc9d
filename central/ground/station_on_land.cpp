#include "central/ground/station_on_land.h"

#include <cmath>

#include "conditions/alarms.h"
#include "geometry/wgs84.h"

namespace ols::fusion {

Alarm station_on_land(const std::string& station, const Eigen::Vector3d& camera_ecef,
                      const Eigen::Vector3d& camera_sd_enu_m, const land::Surface& surface) {
  constexpr double kSigmas = 3.0;
  const Geodetic camera = geodetic_from_ecef(camera_ecef);
  const auto ground = surface.ground(camera.latitude_rad, camera.longitude_rad);
  if (!ground) return alarm::station_outside_land(station);
  const double under_m = ground->height_m - camera.height_m;
  if (under_m <= kSigmas * std::hypot(ground->sd_m, camera_sd_enu_m.z())) return {};
  return alarm::station_under_land(station, under_m);
}

}  // namespace ols::fusion
