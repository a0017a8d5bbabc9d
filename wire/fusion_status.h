// Reads the fusion's status, for all programs.
#pragma once

#include <cstdint>
#include <optional>

#include "base/bus/bus_inbox.h"
#include "ols_msg/fusion_status_t.hpp"

namespace ols::wire {

// Returns nullopt if the message is not a fusion's status. The status's texts are made safe for a
// terminal (base/text/plain_text.h).
std::optional<ols_msg::fusion_status_t> decode_fusion_status(const BusMessage& message);

// "waiting", "searched", "found", "forbidden".
const char* cue_state_name(std::int8_t state);

}  // namespace ols::wire
