// Converts TOML to a list of values with their full keys, and back. Pure.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace ols::setup {

// Pairs such as ("pose.latitude_deg", "49.2"); the value is in TOML notation.
using Values = std::vector<std::pair<std::string, std::string>>;

// The values of a text, sorted by key. Throws std::runtime_error if the text is not valid TOML.
Values flat(const std::string& toml);
// The values of one table: keys that begin with `table` and a dot, without that prefix.
Values of_table(const Values& values, const std::string& table);
// The value of a key; null if the key is missing.
const std::string* find(const Values& values, const std::string& key);
// The text in a value; nullopt: the value is not a text.
std::optional<std::string> text_in(const std::string& value);
// The texts in a list; nullopt: the value is not a list of texts.
std::optional<std::vector<std::string>> texts_in(const std::string& value);
// The values as TOML, one "key = value" per line.
std::string as_toml(const Values& values);

}  // namespace ols::setup
