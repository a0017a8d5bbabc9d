#include "sim/ptu/command_text.h"

#include <algorithm>
#include <charconv>

namespace ols::sim {

std::string star(std::string_view text) {
  std::string answer = "* ";
  answer += text;
  return answer;
}

std::optional<int> whole_number(std::string_view text) {
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::optional<std::vector<int>> whole_numbers(std::string_view text) {
  std::vector<int> values;
  while (true) {
    const std::size_t comma = std::min(text.find(','), text.size());
    const auto value = whole_number(text.substr(0, comma));
    if (!value) return std::nullopt;
    values.push_back(*value);
    if (comma == text.size()) return values;
    text.remove_prefix(comma + 1);
  }
}

}  // namespace ols::sim
