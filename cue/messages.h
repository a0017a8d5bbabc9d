// Converts cues to messages of the bus.
#pragma once

#include <cstdint>

#include "cue/live_cues.h"
#include "ols_msg/cue_t.hpp"

namespace ols::cues {

struct Stamp {
  std::int64_t utime_us = 0, boot_id = 0, sequence = 0;
};

ols_msg::cue_t to_message(const LiveCue& cue, const Stamp& stamp);

}  // namespace ols::cues
