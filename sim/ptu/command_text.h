// The texts of the PTU's command language: numbers in commands, and the common parts of answers.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ols::sim {

// Answers to commands that a unit does not understand (transcripts of real units).
constexpr const char* kIllegalCommand = "! Illegal Command Entered";
constexpr const char* kIllegalArgument = "! Illegal argument";
constexpr const char* kAxisError = "! Axis Error";

// The answer to a query.
std::string star(std::string_view text);

// The whole text, or nullopt.
std::optional<int> whole_number(std::string_view text);
// `1,-2,3`.
std::optional<std::vector<int>> whole_numbers(std::string_view text);

}  // namespace ols::sim
