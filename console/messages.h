// Converts messages of the bus to the console's own values. Each function returns nullopt for a
// message that cannot be decoded, has another schema, or does not name the station of its channel.
// Texts are made safe to show (base/text/plain_text.h).
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "base/bus/bus_inbox.h"
#include "console/received.h"
#include "console/seen_skylines.h"

namespace ols::console {

std::optional<ReceivedStation> station_from(const BusMessage& message);
// The station's name and its bearing.
std::optional<std::pair<std::string, Json>> bearing_from(const BusMessage& message);
// Also nullopt on any channel but kTargetChannel, because the estimate by the paper's method
// (OLS_TARGET_PAPER) is not shown as a target.
std::optional<ReceivedTarget> target_from(const BusMessage& message);
std::optional<ReceivedSkyline> skyline_from(const BusMessage& message);
std::optional<ReceivedOcclusion> occlusion_from(const BusMessage& message);
std::optional<ReceivedFusion> fusion_from(const BusMessage& message);

}  // namespace ols::console
