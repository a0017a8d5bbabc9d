// Removes secrets from a text before strangers see it. Pure.
#pragma once

#include <string>

namespace ols::doctor {

// Returns the text with "[removed]" in place of possible secrets: private keys in PEM, long
// hexadecimal numbers, stored passwords, user names and passwords in URLs, and the values after the
// name of a key, password or similar. Such a value is removed to the end of its line; a quoted or
// bracketed value, to the end of its last line. When in doubt, the function removes the text. Lines
// longer than kLongestLine are cut.
std::string without_secrets(const std::string& text);
inline constexpr std::size_t kLongestLine = 2000;

// The same for a TOML file, which it parses. If the file cannot be parsed, returns only the
// position of the error.
std::string without_secrets_of_toml(const std::string& text);

}  // namespace ols::doctor
