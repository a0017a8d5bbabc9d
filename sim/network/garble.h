// The effect of a bad line on a text. Pure.
#pragma once

#include <random>
#include <string>

namespace ols::sim {

// Damages one byte of a non-empty text: deletes it, flips one of its bits, or duplicates it.
inline void spoil_one_byte(std::string& text, std::mt19937_64& random) {
  if (text.empty()) return;
  const std::size_t at = std::uniform_int_distribution<std::size_t>(0, text.size() - 1)(random);
  switch (std::uniform_int_distribution<int>(0, 2)(random)) {
    case 0:
      text.erase(at, 1);
      break;
    case 1:
      text[at] =
          static_cast<char>(text[at] ^ (1 << std::uniform_int_distribution<int>(0, 6)(random)));
      break;
    default:
      text.insert(at, 1, text[at]);
  }
}

}  // namespace ols::sim
