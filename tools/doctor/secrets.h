// Makes a text safe to show to strangers. Pure.
#pragma once

#include <string>

namespace ols::doctor {

// The text with "[removed]" in place of possible secrets: everything behind the name of a key,
// password or similar, up to the end of its line, or of its last line if it is quoted or bracketed;
// private keys in PEM; long hexadecimal numbers; stored passwords; user names and passwords in
// URLs. It removes too much rather than too little. Lines longer than kLongestLine are cut.
std::string without_secrets(const std::string& text);
inline constexpr std::size_t kLongestLine = 2000;

// The same for a TOML file, by its grammar. If it cannot be parsed, only the position of the error
// is given.
std::string without_secrets_of_toml(const std::string& text);

}  // namespace ols::doctor
