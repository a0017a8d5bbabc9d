// In messages, a state is a small number. Converts such numbers to enumerations with the same
// values, or to words from a list in the order of the numbers.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace ols {

template <class Enum>
constexpr std::int8_t code(Enum value) {
  return static_cast<std::int8_t>(value);
}

// The enumeration's value for `number`; `otherwise` if the number is not within 0 to `last`.
template <class Enum>
constexpr Enum from_code(std::int8_t number, Enum last, Enum otherwise) {
  return number >= 0 && number <= code(last) ? static_cast<Enum>(number) : otherwise;
}

template <std::size_t N>
constexpr const char* word_of_code(std::int8_t number, const std::array<const char*, N>& words,
                                   const char* otherwise = "unknown") {
  const auto i = static_cast<std::size_t>(number);
  return i < N ? words[i] : otherwise;
}

}  // namespace ols
