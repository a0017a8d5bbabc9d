// The heading that a first sighting tells, so that the next targets are where they are expected.
// Pure.
#pragma once

#include <optional>

#include "geometry/station_model.h"

namespace ols::calibration {

// With which the pixel shows what stands there (ECEF, [m]); the mounting's error is in it. Nothing
// where the pixel cannot be unprojected. Radians, 0 to 2 pi.
std::optional<double> learned_heading(const StationModel& model, const UnitReading& reading,
                                      const Eigen::Vector2d& pixel, const Eigen::Vector3d& ecef);

}  // namespace ols::calibration
