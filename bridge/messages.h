// Reads the parts of the fusion's messages that the bridge needs.
#pragma once

#include <cstdint>
#include <optional>

#include "bridge/ownership/ownership.h"
#include "bridge/passage.h"

namespace ols::bridge {

// The target of a fusion message (a target or a slew; 0: it concerns none). nullopt if it is no
// such message. `payload`: without its signature.
std::optional<std::int64_t> target_id_of(Kind kind, Bytes payload);
// A target at the message's position. nullopt: the message states no position, or the end of the
// target.
std::optional<Track> track_from(Bytes payload);
// Another owner's target, from such a message.
std::optional<TargetReport> sighting_from(const Headers& headers, Bytes payload);

}  // namespace ols::bridge
