// The bus's messages as the console's own values. Nothing for what cannot be decoded, is of another
// schema, or not of the station of its channel. Texts are made safe to show (base/plain_text.h).
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/bus_inbox.h"
#include "console/heard.h"

namespace ols::console {

std::optional<StationHeard> station_from(const BusMessage& message);
// The station and the bearing.
std::optional<std::pair<std::string, Json>> bearing_from(const BusMessage& message);
std::optional<TargetHeard> target_from(const BusMessage& message);
std::optional<FusionHeard> fusion_from(const BusMessage& message);
std::optional<Picture> picture_from(const BusMessage& message);

// Of a station's video socket (docs/video.md), not of the bus: a request and its answer.
std::vector<std::uint8_t> video_request(std::int64_t after_utime_us, int max_width_px, int quality);
std::optional<Picture> video_picture_from(std::span<const std::uint8_t> bytes);

}  // namespace ols::console
