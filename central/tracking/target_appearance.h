// Class, size and signal of a target, from the stations' detectors. Pure.
#pragma once

#include <Eigen/Core>

#include "central/classify/class_posterior.h"
#include "central/tracking/track.h"
#include "land/surface.h"

namespace ols::fusion {

// What the object is, and how well it is seen; 0 if unknown.
struct Appearance {
  ObjectClass object_class = ObjectClass::kUnknown;  // the most probable class
  double class_probability = 0.0;                    // 0..1, probability of this class
  double size_m = 0.0, size_sd_m = 0.0;              // largest extent, and its 1-sigma
  double signal = 0.0;  // signal-to-noise ratio in one picture, for the station that sees it best
};

// Uses the newest bearing of each station that says what it has seen, for a target at this
// position: the weighted mean of the sizes, and the largest signal. The class is that of the
// track's whole life. If stations state classes for their images, the class follows from these
// alone.
Appearance appearance_of(const Track& track, const Eigen::Vector3d& p_ecef);

// Lets the track's classifier take a look, at most five times a second. surface: of the land; may
// be null.
void look_at_class(Track& track, const land::Surface* surface);

}  // namespace ols::fusion
