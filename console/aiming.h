// The angles to which a station's unit must turn to look at a place. Pure.
#pragma once

#include <optional>

#include "console/entity_table.h"
#include "geometry/kinematic_chain.h"
#include "geometry/wgs84.h"

namespace ols::console {

// The angles as the unit counts them, within its travel. `station`: the fields of its last status
// (docs/console.md). nullopt if the station does not know its orientation, or cannot reach the
// angles.
std::optional<PanTilt> aim_at_place(const Json& station, const Geodetic& place);

}  // namespace ols::console
