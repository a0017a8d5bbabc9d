// Cursor on Target: an event as XML, or as a message of the TAK protocol, version 1. Pure.
//
// The errors ce (circular) and le (linear) are taken as one sigma, as in the schema. Some sources
// state the 90 % error instead. Their cues are then more accurate than assumed.
#pragma once

#include <string>

#include "cue/reading.h"

namespace ols::cues {

// Selects events by the beginnings of their types: "a-" is everything, "a-h-A" hostile objects in
// the air.
using CotTypes = std::vector<std::string>;

Reading cot_reading(const std::string& message, const CotTypes& types);

}  // namespace ols::cues
