#include "calibration/procedure/sun_keep_out.h"

#include <algorithm>
#include <cmath>

#include "conditions/printed.h"
#include "geometry/angles.h"

namespace ols::calibration {
namespace {

bool is_up(const Eigen::Vector3d& sun_enu) {
  constexpr double kSet_deg = -2.0;  // nothing of it is seen below
  return sun_enu.z() >= std::sin(radians(kSet_deg));
}

}  // namespace

bool SunKeepOut::is_up() const { return calibration::is_up(sun_enu()); }

Eigen::Vector3d SunKeepOut::sun_enu() const {
  const Geodetic& place = model_.geometry.position;
  const SkyDirection sun = sun_direction(now_(), place, standard_air(place.height_m), {});
  return LocalFrame(place).R_ecef_enu().transpose() * sun.ecef;
}

std::string SunKeepOut::hindrance(const PanTilt& angles, double doubt_rad) const {
  if (lifted_) return {};
  const Eigen::Vector3d sun = sun_enu();
  if (!calibration::is_up(sun)) return {};
  const Eigen::Vector3d axis = enu_from_azimuth_elevation(optical_axis(model_.geometry, angles));
  const double apart_deg = degrees(std::acos(std::clamp(axis.dot(sun), -1.0, 1.0)));
  const double kept_deg = kRadius_deg + degrees(doubt_rad);
  if (apart_deg >= kept_deg) return {};
  return printed("the sun stands %.0f degrees beside it: %.0f are kept", apart_deg, kept_deg);
}

}  // namespace ols::calibration
