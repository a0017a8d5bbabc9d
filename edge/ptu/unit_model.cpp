#include "edge/ptu/unit_model.h"

#include <cctype>
#include <charconv>
#include <vector>

namespace ols::ptu {

namespace {

// `v2.12.1d1(C14/E)`: the first word that is a v and a digit.
std::string_view version_word(std::string_view text) {
  for (std::size_t i = 0; i + 1 < text.size(); ++i) {
    const bool begins = i == 0 || text[i - 1] == ' ';
    const bool digit = std::isdigit(static_cast<unsigned char>(text[i + 1])) != 0;
    if (!begins || (text[i] != 'v' && text[i] != 'V') || !digit) continue;
    return text.substr(i, text.find_first_of(" ,", i) - i);
  }
  return {};
}

// Every number in the text.
std::vector<double> numbers_in(std::string_view text) {
  std::vector<double> numbers;
  while (!text.empty()) {
    double value = 0.0;
    const auto [end, error] =
        std::from_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed);
    if (error == std::errc{}) {
      numbers.push_back(value);
      text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    } else {
      text.remove_prefix(1);
    }
  }
  return numbers;
}

double celsius(double fahrenheit) { return (fahrenheit - 32.0) / 1.8; }

// Plausible for electronics; from_chars accepts `inf` and `nan`.
bool sensible(const std::vector<double>& numbers) {
  for (const double n : numbers) {
    if (!(n >= -100.0 && n <= 400.0)) return false;
  }
  return numbers[0] >= 0.0 && numbers[0] <= 60.0;
}

}  // namespace

PtuModel ptu_model(std::string_view version_text) {
  const std::string_view word = version_word(version_text);
  if (word.size() < 2) return PtuModel::kUnknown;
  if (word[1] == '3') return PtuModel::kESeries;
  return word[1] == '1' || word[1] == '2' ? PtuModel::kClassic : PtuModel::kUnknown;
}

std::string ptu_name(std::string_view version_text) {
  const std::string word(version_word(version_text));
  switch (ptu_model(version_text)) {
    case PtuModel::kClassic:
      return "PTU-D46 " + word;
    case PtuModel::kESeries:
      return "PTU-E46 " + word;
    case PtuModel::kUnknown:
      break;
  }
  return std::string(version_text.substr(0, 60));
}

std::optional<PtuEnvironment> ptu_environment(std::string_view text) {
  const std::vector<double> n = numbers_in(text);
  if ((n.size() != 2 && n.size() != 4) || !sensible(n)) return std::nullopt;
  PtuEnvironment environment;
  environment.supply_V = n[0];
  environment.head_degC = celsius(n[1]);
  if (n.size() == 4) {
    environment.pan_degC = celsius(n[2]);
    environment.tilt_degC = celsius(n[3]);
  }
  return environment;
}

}  // namespace ols::ptu
