// What the configurations of the sensors say to the pose estimator. Pure.
#pragma once

#include "edge/sensors/gnss.h"
#include "edge/sensors/inclinometer.h"
#include "edge/sensors/pose_estimator.h"

namespace ols {

// Everything but what [pose] configures.
void set_sensors(PoseEstimator::Config& estimator, const InclinometerConfig& inclinometer,
                 const GnssConfig& gnss);

}  // namespace ols
