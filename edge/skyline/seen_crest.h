// Combines the seen skyline and the map at one azimuth, according to their errors. Pure.
#pragma once

#include <optional>

#include "edge/skyline/seen_horizon.h"
#include "land/horizon_map.h"
#include "land/seen_skyline.h"

namespace ols::skyline {

// `elevation_sd_rad`: 1-sigma that the station states for its elevations.
//
// - Both agree within three sigmas: the crest is the mean, weighted by their variances, at the
//   distance of the map's crest.
// - The pictures show something higher, at an unknown distance. Suppose that it is kTallest_m high.
//   It hides targets beyond the farthest place, up to the map's crest, where its top reaches that
//   elevation.
// - The pictures show something lower: they do not change what the map hides, because haze may
//   conceal the map's crest.
//
// nullopt where the map knows no land.
std::optional<land::SeenCrest> seen_crest(const SeenPlace& seen, double elevation_sd_rad,
                                          const land::HorizonMap& map);

// Trees and houses are lower; anything higher is rare.
inline constexpr double kTallest_m = 30.0;

}  // namespace ols::skyline
