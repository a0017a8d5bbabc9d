// Where a unit may not point, as directions on the sky: the border of its travel, and of each
// keep-out region, for people to see on a map and in a picture. Pure.
#pragma once

#include <array>
#include <vector>

#include "edge/ptu/servo.h"
#include "geometry/direction.h"
#include "geometry/kinematic_chain.h"

namespace ols::station {

inline constexpr int kBorderPoints = 16;

struct Border {
  bool is_keep_out = false;  // inside is forbidden; else outside is
  // Of the optical axis, once round the region, beginning at its least pan and tilt: four from each
  // corner to the next.
  std::array<AzimuthElevation, kBorderPoints> outline;
};

// The travel first, when it is known; then what of each keep-out region lies within it.
std::vector<Border> borders(const ChainParameters& chain, const ptu::PtuLimits& limits,
                            bool is_travel_known);

}  // namespace ols::station
