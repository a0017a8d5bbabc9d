// Converts pictures from the bus, and from a station's video socket (docs/video.md), to the
// console's own values.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/bus/bus_inbox.h"
#include "console/received.h"

namespace ols::console {

std::optional<Picture> picture_from(const BusMessage& message);

// The bytes of a request to a station's video socket (not to the bus) for a picture later than
// `after_utime_us`.
std::vector<std::uint8_t> video_request(std::int64_t after_utime_us, int max_width_px, int quality);
// The same for H.264. key_frame: whether the answer must be decodable without earlier units.
std::vector<std::uint8_t> stream_request(std::int64_t after_utime_us, int max_width_px, int quality,
                                         bool key_frame);
std::optional<Picture> video_picture_from(std::span<const std::uint8_t> bytes, Codec codec);

}  // namespace ols::console
