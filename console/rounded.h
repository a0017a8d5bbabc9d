// Converts numbers from messages to JSON for a browser.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>

#include "console/received.h"
#include "geometry/angles.h"

namespace ols::console {

// The number with this many decimals, because a browser does not need 17 digits ten times a second;
// null if the number is not finite.
inline Json rounded(double value, int decimals) {
  if (!std::isfinite(value) || std::abs(value) > 1e15) return nullptr;
  const double scale = std::pow(10.0, decimals);
  return std::round(value * scale) / scale;
}
inline Json angle_deg(double rad) { return rounded(degrees(rad), 4); }

template <std::size_t count>
Json rounded_all(const double (&values)[count], int decimals) {
  Json result = Json::array();
  for (const double value : values) result.push_back(rounded(value, decimals));
  return result;
}

// A number as text, because JavaScript's numbers cannot hold 64 bits.
inline std::string number_text(std::int64_t number) { return std::to_string(number); }

}  // namespace ols::console
