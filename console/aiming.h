// Computes the pan and tilt at which a station's camera looks at a place. Pure.
#pragma once

#include <optional>

#include "console/entity_table.h"
#include "geometry/kinematic_chain.h"
#include "geometry/wgs84.h"

namespace ols::console {

// The angles as the PTU counts them, within its travel. `station`: the fields of the station's last
// status (docs/console.md). nullopt if the station does not know its orientation, or if the PTU
// cannot reach the angles.
std::optional<PanTilt> aim_at_place(const Json& station, const Geodetic& place);

}  // namespace ols::console
