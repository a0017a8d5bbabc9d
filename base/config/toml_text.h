// A text in TOML's notation.
#pragma once

#include <string>

namespace ols {

// Quoted, on one line and in ASCII: quotes, backslashes, control characters and all letters beyond
// ASCII are escaped.
std::string toml_text(const std::string& text);

}  // namespace ols
