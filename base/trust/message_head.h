// Reads from the beginning of a message, whatever its type, when it was sent and by whom. Pure.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "base/trust/crypto.h"

namespace ols::trust {

enum class HeadForm {
  kStationFirst,  // utime, schema, station, boot id, sequence: messages of a station
  kBootFirst,     // utime, schema, boot id, sequence: commands, and messages of the fusion
  kUtimeOnly,     // utime: messages of the simulator
};

struct MessageHead {
  std::int64_t utime_us = 0;
  std::string_view station;  // empty except in kStationFirst
  std::int64_t boot_id = 0;
  std::int64_t sequence = 0;
};

// nullopt if the payload is too short.
std::optional<MessageHead> read_head(Bytes payload, HeadForm form);

}  // namespace ols::trust
