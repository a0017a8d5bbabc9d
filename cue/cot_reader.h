// Cursor on Target: an event as XML, or as a message of the TAK protocol, version 1. Pure.
//
// ce and le count as one sigma, as in the schema. A source whose values mean 90 % thus states a
// larger error than it has.
#pragma once

#include <string>

#include "cue/reading.h"

namespace ols::cues {

// The types of wanted events, by their beginnings: "a-" is everything, "a-h-A" hostile objects in
// the air.
using CotTypes = std::vector<std::string>;

Reading cot_reading(const std::string& message, const CotTypes& types);

}  // namespace ols::cues
