#include "calibration/procedure/learned_heading.h"

#include "geometry/angles.h"

namespace ols::calibration {

std::optional<double> learned_heading(const StationModel& model, const UnitReading& reading,
                                      const Eigen::Vector2d& pixel, const Eigen::Vector3d& ecef) {
  PixelSight seen;
  seen.pixel = pixel;
  seen.angles = corrected_angles(model, reading);
  const auto line = sight(model.geometry, seen);
  if (!line) return std::nullopt;
  const LocalFrame horizon(geodetic_from_ecef(line->origin_ecef));
  const AzimuthElevation there = azimuth_elevation_from_enu(horizon.to_enu(ecef));
  return wrap_two_pi(model.geometry.chain.heading_rad + there.azimuth_rad -
                     line->direction.azimuth_rad);
}

}  // namespace ols::calibration
