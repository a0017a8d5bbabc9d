// The borders of the region where a unit may point, as directions on the sky: the border of its
// travel, and of each keep-out region. They are shown on the map and in pictures. Pure.
#pragma once

#include <array>
#include <vector>

#include "edge/mount/limits.h"
#include "geometry/direction.h"
#include "geometry/kinematic_chain.h"

namespace ols::station {

inline constexpr int kBorderPoints = 16;

struct Border {
  bool is_keep_out = false;  // the inside is forbidden; false: the outside is
  // Directions of the optical axis once round the region, beginning at its smallest pan and tilt:
  // four on each side.
  std::array<AzimuthElevation, kBorderPoints> outline;
};

// The travel first, if it is known and not empty; then the part of each keep-out region inside it.
std::vector<Border> borders(const ChainParameters& chain, const mount::Limits& limits,
                            bool is_travel_known);

}  // namespace ols::station
