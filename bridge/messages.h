// What the bridge reads of the fusion's messages.
#pragma once

#include <cstdint>
#include <optional>

#include "bridge/ownership/ownership.h"
#include "bridge/passage.h"

namespace ols::bridge {

// The target of a message of the fusion: of a target or a slew (0: it concerns none). Nothing if it
// is no such message. `payload`: without its signature.
std::optional<std::int64_t> target_id_of(Kind kind, Bytes payload);
// A target that is where the message says; nothing if it says no place, or that it is over.
std::optional<Track> track_from(Bytes payload);
// What another owner says of its target with such a message.
std::optional<Sighting> sighting_from(const Headers& headers, Bytes payload);

}  // namespace ols::bridge
