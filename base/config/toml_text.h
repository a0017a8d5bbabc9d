// Writes a string in TOML's notation.
#pragma once

#include <string>

namespace ols {

// The text in quotes, on one line and in ASCII. Quotes, backslashes, control characters and all
// characters beyond ASCII are escaped.
std::string toml_text(const std::string& text);

}  // namespace ols
