// Derives the settings of the pose estimator from the sensors' configurations. Pure.
#pragma once

#include "edge/sensors/gnss.h"
#include "edge/sensors/inclinometer.h"
#include "edge/sensors/pose_estimator.h"

namespace ols::sensors {

// Sets everything except the settings that belong to [pose].
void set_sensors(PoseEstimator::Config& estimator, const InclinometerConfig& inclinometer,
                 const GnssConfig& gnss);

}  // namespace ols::sensors
