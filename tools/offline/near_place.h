// Detects that latitude and longitude were exchanged: such a place is usually on another continent.
#pragma once

#include <string>
#include <vector>

#include "geometry/wgs84.h"

namespace ols::offline {

inline constexpr double kCameraRange_m = 500e3;  // the limit that the fusion also has

// Throws std::invalid_argument if `place` is more than `farthest_m` from every place in `near`. In
// the error's text, `name` is the name of the place, and `of` the name of the group `near`.
void require_near(const std::string& name, const Geodetic& place, const std::vector<Geodetic>& near,
                  const std::string& of, double farthest_m = kCameraRange_m);

}  // namespace ols::offline
