// From which height on a place is in sight.
#pragma once

#include <optional>

#include "land/horizon_map.h"

namespace ols::land {

// The height above the WGS84 ellipsoid [m] from which on the land does not hide what is above this
// place from the map's camera. In sight of the camera down to the ground, it is the surface's own
// height, to a fraction of the map's cells. Nothing where the land in between is not known.
std::optional<double> lowest_visible_m(const HorizonMap& map, double latitude_rad,
                                       double longitude_rad);

}  // namespace ols::land
