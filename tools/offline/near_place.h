// Detects that latitude and longitude were exchanged, which puts a place on another continent.
#pragma once

#include <string>
#include <vector>

#include "geometry/wgs84.h"

namespace ols::offline {

inline constexpr double kCameraRange_m = 500e3;  // the same limit as in the fusion

// Throws std::invalid_argument if `place` is further than `farthest_m` from each of `near`. Errors
// name the place `name` and the group `of` to which `near` belongs.
void require_near(const std::string& name, const Geodetic& place, const std::vector<Geodetic>& near,
                  const std::string& of, double farthest_m = kCameraRange_m);

}  // namespace ols::offline
