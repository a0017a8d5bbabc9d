// One azimuth of the seen skyline and of the map, fused by their errors. Pure.
#pragma once

#include <optional>

#include "edge/skyline/seen_horizon.h"
#include "land/horizon_map.h"
#include "land/seen_skyline.h"

namespace ols::skyline {

// `elevation_sd_rad`: 1-sigma that the station states for its elevations.
//
// Where both agree within three sigmas, the mean weighted by their variances stands at the map's
// crest. What is seen higher stands at an unknown distance: it hides what is beyond the map's
// crest if something kTallest_m high there would reach so far up, and otherwise what is beyond the
// farthest nearer place from which it would. What is seen lower hides nothing that the map does not
// hide: haze may conceal the crest.
//
// nullopt where the map knows no land.
std::optional<land::SeenCrest> seen_crest(const SeenPlace& seen, double elevation_sd_rad,
                                          const land::HorizonMap& map);

// Trees and houses; what is higher is rare.
inline constexpr double kTallest_m = 30.0;

}  // namespace ols::skyline
