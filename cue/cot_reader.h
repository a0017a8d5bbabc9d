// Cursor on Target: an event as XML, or as a message of the TAK protocol, version 1. Pure.
//
// ce and le count as one sigma, as the schema has it; who means 90 % says more than is asked for.
#pragma once

#include <string>

#include "cue/reading.h"

namespace ols::cues {

// Events whose type begins with one of these are wanted: "a-" is all things, "a-h-A" hostile ones
// in the air.
using CotTypes = std::vector<std::string>;

Reading cot_reading(const std::string& message, const CotTypes& types);

}  // namespace ols::cues
