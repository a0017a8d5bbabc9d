// A text that may be shown to strangers. Pure.
#pragma once

#include <string>

namespace ols::doctor {

// The text with "[removed]" in place of what may be a secret: the value of whatever is called a
// key, password or the like; private keys in PEM; long hexadecimal numbers; user names and
// passwords in URLs. Rather too much than too little. Lines longer than kLongestLine are cut.
std::string without_secrets(const std::string& text);
inline constexpr std::size_t kLongestLine = 2000;

}  // namespace ols::doctor
