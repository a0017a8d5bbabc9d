// A text as TOML writes it.
#pragma once

#include <string>

namespace ols {

// In quotes, on one line and in ASCII: quotes, backslashes, control characters and all letters
// beyond ASCII are escaped.
std::string toml_text(const std::string& text);

}  // namespace ols
