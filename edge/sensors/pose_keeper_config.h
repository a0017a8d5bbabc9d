// What the configurations of the sensors say to the pose keeper. Pure.
#pragma once

#include "edge/sensors/gnss.h"
#include "edge/sensors/inclinometer.h"
#include "edge/sensors/pose_keeper.h"

namespace ols {

// Everything but the survey, which stands in [pose].
PoseKeeper::Config pose_keeper_config(const InclinometerConfig& inclinometer,
                                      const GnssConfig& gnss);

}  // namespace ols
