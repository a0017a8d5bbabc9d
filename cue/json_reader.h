// Reads a cue from a line of JSON (docs/cues.md), for sources that have no format of their own.
// Pure.
#pragma once

#include <cstdint>
#include <string>

#include "cue/reading.h"

namespace ols::cues {

// `now_us`: time of the cue if the line states none.
Reading json_reading(const std::string& line, std::int64_t now_us);

}  // namespace ols::cues
