// Copies settings from the sensors' configurations to that of the pose estimator. Pure.
#pragma once

#include "edge/sensors/gnss.h"
#include "edge/sensors/inclinometer.h"
#include "edge/sensors/pose_estimator.h"

namespace ols::sensors {

// Sets the members of `estimator` that the sections of the sensors determine. The section [pose]
// determines the others.
void set_sensors(PoseEstimator::Config& estimator, const InclinometerConfig& inclinometer,
                 const GnssConfig& gnss);

}  // namespace ols::sensors
