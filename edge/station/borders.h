// Computes the directions that bound the region in which a unit may point: the borders of its
// travel, and of each keep-out region. They are drawn on the map and in pictures. Pure.
#pragma once

#include <array>
#include <vector>

#include "edge/mount/limits.h"
#include "geometry/direction.h"
#include "geometry/kinematic_chain.h"

namespace ols::station {

inline constexpr int kBorderPoints = 16;

struct Border {
  bool is_keep_out = false;  // true: the inside is forbidden; false: the outside is forbidden
  // Directions of the optical axis, once around the region, four on each side. The first has the
  // region's smallest pan and tilt.
  std::array<AzimuthElevation, kBorderPoints> outline;
};

// The first border is that of the travel, if it is known and not empty. Then follows, for each
// keep-out region, the border of the part that is inside the travel.
std::vector<Border> borders(const ChainParameters& chain, const mount::Limits& limits,
                            bool is_travel_known);

}  // namespace ols::station
