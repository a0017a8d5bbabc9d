// What every message of the bus begins with, read without its type: when and by whom it was sent.
// Pure.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "base/trust/crypto.h"

namespace ols::trust {

enum class HeadForm {
  kStationFirst,  // utime, schema, station, boot id, sequence: what a station says of itself
  kBootFirst,     // utime, schema, boot id, sequence: commands, and what the fusion says
  kUtimeOnly,     // utime: what the simulator says
};

struct MessageHead {
  std::int64_t utime_us = 0;
  std::string_view station;  // empty but in kStationFirst
  std::int64_t boot_id = 0;
  std::int64_t sequence = 0;
};

// Nothing when the payload is too short for it.
std::optional<MessageHead> read_head(Bytes payload, HeadForm form);

}  // namespace ols::trust
