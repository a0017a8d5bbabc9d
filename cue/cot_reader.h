// Reads events of Cursor on Target, as XML or as messages of the TAK protocol, version 1. Pure.
//
// The errors ce (circular) and le (linear) are read as one sigma, as the schema defines them. Some
// sources state the 90 % error instead; their cues are more accurate than they appear.
#pragma once

#include <string>

#include "cue/reading.h"

namespace ols::cues {

// Selects events by the beginnings of their types: "a-" selects everything, "a-h-A" hostile objects
// in the air.
using CotTypes = std::vector<std::string>;

Reading cot_reading(const std::string& message, const CotTypes& types);

}  // namespace ols::cues
