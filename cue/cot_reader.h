// Cursor on Target: an event as XML, or as a message of the TAK protocol, version 1. Pure.
//
// ce and le are taken as one sigma, as in the schema. If a source means 90 %, its errors are in
// fact smaller.
#pragma once

#include <string>

#include "cue/reading.h"

namespace ols::cues {

// Selects events by the beginnings of their types: "a-" is everything, "a-h-A" hostile objects in
// the air.
using CotTypes = std::vector<std::string>;

Reading cot_reading(const std::string& message, const CotTypes& types);

}  // namespace ols::cues
