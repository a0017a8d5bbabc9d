// Changes values in the text of a TOML file; all else stays as its author wrote it: comments,
// order, other tables.
#pragma once

#include <string>

namespace ols {

// `text` with every value of `changes`, both TOML. A key that is new goes to the end of its table,
// a table that is new to the end. std::runtime_error where the text's form does not let a value be
// changed without changing another.
std::string toml_merged(const std::string& text, const std::string& changes);

}  // namespace ols
