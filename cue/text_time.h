// Reads a time from a text. Pure.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace ols::cues {

// Reads "2026-11-23T10:15:30.250Z": UTC, with any number of decimals or none, years 1970 to 9999.
// Returns [us] since 1970; nullopt for any other text.
std::optional<std::int64_t> utime_of_iso(const std::string& text);

}  // namespace ols::cues
