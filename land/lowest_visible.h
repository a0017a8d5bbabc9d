// The lowest height at which an object above a place is visible.
#pragma once

#include <optional>

#include "land/horizon_map.h"

namespace ols::land {

// The lowest height above the WGS84 ellipsoid [m] at which a point at this latitude and longitude
// is visible from the map's camera. If the ground there is visible, this is the height of the
// surface, to within a fraction of the map's cells. nullopt if the land between camera and place is
// unknown.
std::optional<double> lowest_visible_m(const HorizonMap& map, double latitude_rad,
                                       double longitude_rad);

}  // namespace ols::land
