// Converts bus messages to the console's own values. nullopt for a message that cannot be decoded,
// has another schema, or does not come from the station of its channel. Texts are made safe to show
// (base/text/plain_text.h).
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "base/bus/bus_inbox.h"
#include "console/heard.h"

namespace ols::console {

std::optional<StationHeard> station_from(const BusMessage& message);
// The station's name and its bearing.
std::optional<std::pair<std::string, Json>> bearing_from(const BusMessage& message);
// nullopt for another channel: the paper's estimate is not shown as a target.
std::optional<TargetHeard> target_from(const BusMessage& message);
std::optional<OcclusionHeard> occlusion_from(const BusMessage& message);
std::optional<FusionHeard> fusion_from(const BusMessage& message);

}  // namespace ols::console
