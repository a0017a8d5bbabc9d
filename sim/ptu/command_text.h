// The texts of the PTU's command language: numbers in commands, and the common parts of answers.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ols::sim {

// Answers to invalid commands (from transcripts of real units).
constexpr const char* kIllegalCommand = "! Illegal Command Entered";
constexpr const char* kIllegalArgument = "! Illegal argument";
constexpr const char* kAxisError = "! Axis Error";

// The answer to a query: "* " and the text.
std::string star(std::string_view text);

// Converts the text to a whole number; nullopt: it is not exactly one number.
std::optional<int> whole_number(std::string_view text);
// Converts a list such as `1,-2,3`; nullopt: it is not such a list.
std::optional<std::vector<int>> whole_numbers(std::string_view text);

}  // namespace ols::sim
