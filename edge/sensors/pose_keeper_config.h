// What the configurations of the sensors say to the pose keeper. Pure.
#pragma once

#include "edge/sensors/gnss.h"
#include "edge/sensors/inclinometer.h"
#include "edge/sensors/pose_keeper.h"

namespace ols {

// Everything but what [pose] configures.
void set_sensors(PoseKeeper::Config& keeper, const InclinometerConfig& inclinometer,
                 const GnssConfig& gnss);

}  // namespace ols
