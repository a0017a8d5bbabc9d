// Reads the parts of the fusion's messages that the bridge needs.
#pragma once

#include <cstdint>
#include <optional>

#include "bridge/ownership/ownership.h"
#include "bridge/passage.h"

namespace ols::bridge {

// The target's number in a message of a fusion (a target, a slew or an occlusion); 0: the message
// concerns no target. nullopt if the payload is another message. `payload`: without its signature.
std::optional<std::int64_t> target_id_of(Kind kind, Bytes payload);
// The target in a message. nullopt if the message states no position or ends the target.
std::optional<Track> track_from(Bytes payload);
// Another owner's target, from its message and the headers. nullopt as for track_from(), and if the
// headers state no target.
std::optional<TargetReport> sighting_from(const Headers& headers, Bytes payload);

}  // namespace ols::bridge
