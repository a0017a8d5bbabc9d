// What a target is, from what the stations' detectors saw of it. Pure.
#pragma once

#include <Eigen/Core>

#include "central/fusion/fused_target.h"
#include "central/tracking/track.h"

namespace ols::fusion {

// By the newest bearing of each station, for a target at this position: the weighted mean of the
// sizes, the greatest signal, and the class by all posteriors together (each from one image).
Appearance appearance_of(const Track& track, const Eigen::Vector3d& p_ecef);

}  // namespace ols::fusion
