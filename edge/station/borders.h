// The borders of the region in which a unit may point, as directions: the border of its travel, and
// of each keep-out region. They are drawn on the map and in pictures. Pure.
#pragma once

#include <array>
#include <vector>

#include "edge/mount/limits.h"
#include "geometry/direction.h"
#include "geometry/kinematic_chain.h"

namespace ols::station {

inline constexpr int kBorderPoints = 16;

struct Border {
  bool is_keep_out = false;  // true: the inside is forbidden; false: the outside is
  // Directions of the optical axis once around the region, starting at its smallest pan and tilt:
  // four on each side.
  std::array<AzimuthElevation, kBorderPoints> outline;
};

// First the travel, if it is known and not empty; then, for each keep-out region, the part inside
// the travel.
std::vector<Border> borders(const ChainParameters& chain, const mount::Limits& limits,
                            bool is_travel_known);

}  // namespace ols::station
