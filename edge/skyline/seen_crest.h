// Combines the seen skyline with the map at one azimuth, according to the errors of both. Pure.
#pragma once

#include <optional>

#include "edge/skyline/seen_horizon.h"
#include "land/horizon_map.h"
#include "land/seen_skyline.h"

namespace ols::skyline {

// Returns the crest that hides targets. `elevation_sd_rad`: 1-sigma that the station states for its
// elevations. There are three cases:
//
// - Pictures and map agree within three sigmas: the crest is the mean of the two, weighted by their
//   variances, at the distance of the map's crest.
// - The pictures show something higher, at an unknown distance. It is assumed to be an object
//   kTallest_m high. Of all places up to the map's crest at which the top of such an object reaches
//   the seen elevation, the farthest is assumed. The object hides targets beyond that place.
// - The pictures show something lower: what the map hides does not change, because haze may conceal
//   the map's crest.
//
// nullopt where the map knows no land.
std::optional<land::SeenCrest> seen_crest(const SeenPlace& seen, double elevation_sd_rad,
                                          const land::HorizonMap& map);

// Nearly all trees and houses are lower.
inline constexpr double kTallest_m = 30.0;

}  // namespace ols::skyline
