// Reads a cue from a line of JSON, for sources without a format of their own: docs/cues.md. Pure.
#pragma once

#include <cstdint>
#include <string>

#include "cue/reading.h"

namespace ols::cues {

// `now_us`: used for a line that states no time.
Reading json_reading(const std::string& line, std::int64_t now_us);

}  // namespace ols::cues
