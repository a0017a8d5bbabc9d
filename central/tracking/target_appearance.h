// Class, size and signal of a target, from the stations' detectors. Pure.
#pragma once

#include <Eigen/Core>

#include "central/classify/class_posterior.h"
#include "central/tracking/track.h"
#include "land/surface.h"

namespace ols::fusion {

// The object's class and size, and how well it is seen. 0 if unknown.
struct Appearance {
  ObjectClass object_class = ObjectClass::kUnknown;  // the most probable class
  double class_probability = 0.0;                    // 0..1, probability of this class
  double size_m = 0.0, size_sd_m = 0.0;              // largest extent, and its 1-sigma
  double signal = 0.0;  // signal-to-noise ratio in one picture, for the station that sees it best
};

// The appearance of a target at this position: the weighted mean of the stations' sizes, and the
// largest signal. Of each station, uses the newest bearing that states a size, a signal or a class.
// If stations state classes, the class follows from these alone. Otherwise it is the most probable
// class over the track's whole life (track.classes).
Appearance appearance_of(const Track& track, const Eigen::Vector3d& p_ecef);

// Updates track.classes from the track's present motion, size and height above ground; at most five
// times a second. surface: the land; may be null.
void look_at_class(Track& track, const land::Surface* surface);

}  // namespace ols::fusion
