// Detects exchanged latitude and longitude, which put a place on another continent.
#pragma once

#include <string>
#include <vector>

#include "geometry/wgs84.h"

namespace ols::offline {

inline constexpr double kCameraRange_m = 500e3;  // as the fusion has it

// Throws std::invalid_argument if `place` is further than `farthest_m` from each of `near`, which
// belong to `of`.
void require_near(const std::string& name, const Geodetic& place, const std::vector<Geodetic>& near,
                  const std::string& of, double farthest_m = kCameraRange_m);

}  // namespace ols::offline
