// Computes the heading from a first sighting. With this heading, the next targets appear where they
// are expected. Pure.
#pragma once

#include <optional>

#include "geometry/station_model.h"

namespace ols::calibration {

// The heading at which the pixel shows this point (ECEF [m]), 0 to 2 pi. The error of the camera's
// mounting becomes part of the heading. nullopt if the pixel cannot be unprojected.
std::optional<double> learned_heading(const StationModel& model, const UnitReading& reading,
                                      const Eigen::Vector2d& pixel, const Eigen::Vector3d& ecef);

}  // namespace ols::calibration
