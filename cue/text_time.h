// Instants as text. Pure.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace ols::cues {

// "2026-11-23T10:15:30.250Z": UTC, with any number of decimals or none; years 1970 to 9999.
std::optional<std::int64_t> utime_of_iso(const std::string& text);

}  // namespace ols::cues
