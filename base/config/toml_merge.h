// Changes values in the text of a TOML file. Everything else stays as its author wrote it:
// comments, order, other tables.
#pragma once

#include <string>

namespace ols {

// Returns `text` with every value of `changes` set; both are TOML. A new key is added at the end of
// its table, a new table at the end of the text. Throws std::runtime_error if the text is written
// so that a value cannot be changed without changing another.
std::string toml_merged(const std::string& text, const std::string& changes);

}  // namespace ols
