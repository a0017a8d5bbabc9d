// What a target is, from what the stations' detectors saw of it. Pure.
#pragma once

#include <Eigen/Core>

#include "central/classify/class_posterior.h"
#include "central/tracking/track.h"

namespace ols::fusion {

// What the object is and how well it is seen; 0: unknown.
struct Appearance {
  ObjectClass object_class = ObjectClass::kUnknown;  // the most probable one
  double class_probability = 0.0;                    // 0..1 of this class
  double size_m = 0.0, size_sd_m = 0.0;              // largest extent, and its 1-sigma
  double signal = 0.0;  // signal-to-noise ratio in one picture, of the station that sees it best
};

// Uses the newest bearing of each station, for a target at this position: the weighted mean of the
// sizes, and the greatest signal. The class is that of the track's life; where stations state
// classes of their images, that of all these together.
Appearance appearance_of(const Track& track, const Eigen::Vector3d& p_ecef);

// Takes a look at what the track is, at most five times a second.
void look_at_class(Track& track);

}  // namespace ols::fusion
