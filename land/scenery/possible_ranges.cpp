#include "land/scenery/possible_ranges.h"

#include <algorithm>
#include <cmath>

#include "land/refraction.h"

namespace ols::scenery {

std::optional<RangeInterval> possible_ranges(const land::Surface& surface, const LocalFrame& camera,
                                             const AzimuthElevation& direction,
                                             const RangeInterval& within) {
  constexpr double kTallest_m = 30.0, kSigmas = 3.0;
  constexpr double kStep_m = 10.0, kStep = 0.01;
  std::optional<double> near_m;
  double far_m = within.near_m;
  for (; far_m < within.far_m; far_m += std::max(kStep_m, kStep * far_m)) {
    const Eigen::Vector3d ray_enu = enu_from_azimuth_elevation(land::straight(direction, far_m));
    const Geodetic place = geodetic_from_ecef(camera.to_ecef(far_m * ray_enu));
    const auto ground = surface.ground(place.latitude_rad, place.longitude_rad);
    if (!ground) break;
    const double above_m = place.height_m - ground->height_m;
    if (!near_m && above_m < kTallest_m) near_m = far_m;
    if (above_m < -kSigmas * ground->sd_m) break;
  }
  if (!near_m) return std::nullopt;
  const double step_m = std::max(kStep_m, kStep * *near_m);
  return RangeInterval{std::max(within.near_m, *near_m - step_m),
                       std::max(far_m, *near_m + step_m)};
}

}  // namespace ols::scenery
