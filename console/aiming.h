// Where a station's unit has to turn to look at a place. Pure.
#pragma once

#include <optional>

#include "console/entity_table.h"
#include "geometry/kinematic_chain.h"
#include "geometry/wgs84.h"

namespace ols::console {

// As the unit counts them, and within its travel. `station`: the fields of its last status
// (docs/console.md). Nothing while it does not know where it looks, and for a place that is out of
// reach.
std::optional<PanTilt> aim_at_place(const Json& station, const Geodetic& place);

}  // namespace ols::console
