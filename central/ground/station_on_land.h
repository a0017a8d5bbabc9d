// Whether a station stands on the land that the fusion knows. If not, the fusion predicts nothing
// that the land hides from it. Pure.
#pragma once

#include <Eigen/Core>
#include <string>

#include "conditions/alarm.h"
#include "land/surface.h"

namespace ols::fusion {

// Empty if the camera is above the ground, or below it by no more than three sigmas of the ground
// and of the camera's height. `camera_sd_enu_m`: 1-sigma of its position.
Alarm station_on_land(const std::string& station, const Eigen::Vector3d& camera_ecef,
                      const Eigen::Vector3d& camera_sd_enu_m, const land::Surface& surface);

}  // namespace ols::fusion
