// A text that may be shown to strangers. Pure.
#pragma once

#include <string>

namespace ols::doctor {

// The text with "[removed]" in place of what may be a secret: whatever stands behind the name of a
// key, a password or the like, up to the end of its line or, if it is quoted or bracketed, of its
// last line; private keys in PEM; long hexadecimal numbers, stored passwords; user names and
// passwords in URLs. Rather too much than too little. Lines longer than kLongestLine are cut.
std::string without_secrets(const std::string& text);
inline constexpr std::size_t kLongestLine = 2000;

// The same of a TOML file, whose values are found by its grammar. Of one that cannot be read only
// the place of its error is said.
std::string without_secrets_of_toml(const std::string& text);

}  // namespace ols::doctor
