// Numbers, times and names as text of XML and JSON. Pure.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "export/records.h"

namespace ols::exports {

// With this many decimals; no exponent, and a point whatever the locale. Empty for what is not
// finite.
std::string fixed(double value, int decimals);
// "2026-11-23T10:15:30.250Z"; of years 1970 to 9999.
std::string iso_time(std::int64_t utime_us);
// For an element or an attribute between double quotes; what XML cannot hold becomes "?".
std::string xml(std::string_view text);
// "tentative", "confirmed", "coasted", "ended".
const char* to_string(TrackState state);
// "Unknown", "UAV", "Bird", "Aircraft", "Other".
const char* to_string(ObjectClass object_class);
// What a person calls a target: "OLS 7".
std::string callsign(const Target& target);

}  // namespace ols::exports
