// Between which ranges something along a line of sight can stand, according to the surface. Pure.
#pragma once

#include <functional>
#include <optional>

#include "geometry/direction.h"
#include "geometry/wgs84.h"
#include "land/surface.h"

namespace ols::scenery {

struct RangeInterval {
  double near_m = 0.0, far_m = 0.0;
};

// By direction; nullopt if nothing can stand there.
using PossibleRanges = std::function<std::optional<RangeInterval>(const AzimuthElevation&)>;

// From the first place at which something 30 m high reaches up to the line, to the place at which
// the line is three sigmas of the surface below the ground; within `within`.
std::optional<RangeInterval> possible_ranges(const land::Surface& surface, const LocalFrame& camera,
                                             const AzimuthElevation& direction,
                                             const RangeInterval& within);

}  // namespace ols::scenery
