// Numbers, times and names as text in XML and JSON. Pure.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "export/records.h"

namespace ols::exports {

// The value with this many decimals, without an exponent, and with a decimal point in every locale.
// Empty if the value is not finite.
std::string fixed(double value, int decimals);
// "2026-11-23T10:15:30.250Z"; years 1970 to 9999.
std::string iso_time(std::int64_t utime_us);
// Escapes a text for an XML element, or for an attribute in double quotes. Characters that XML
// cannot hold become "?".
std::string xml(std::string_view text);
// "tentative", "confirmed", "coasted", "ended".
const char* to_string(TrackState state);
// "Unknown", "UAV", "Bird", "Aircraft", "Other": the words that SAPIENT and COURAGEOUS use.
const char* standard_class(ObjectClass object_class);
// A target's name for a person: "OLS 7".
std::string callsign(const Target& target);

}  // namespace ols::exports
