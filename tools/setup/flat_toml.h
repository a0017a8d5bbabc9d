// A TOML text as values by full key. Pure.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace ols::setup {

// ("pose.latitude_deg", "49.2"): the value in TOML notation.
using Values = std::vector<std::pair<std::string, std::string>>;

// In the order of the keys. Throws std::runtime_error if the text is no TOML.
Values flat(const std::string& toml);
// The values of one table: keys that begin with `table` and a dot, without that prefix.
Values of_table(const Values& values, const std::string& table);
// The value of a key; null if it is missing.
const std::string* find(const Values& values, const std::string& key);
// The text of a value; nullopt if it is no text.
std::optional<std::string> text_in(const std::string& value);
// The texts of a list; nullopt if it is no list of texts.
std::optional<std::vector<std::string>> texts_in(const std::string& value);
// One "key = value" per line.
std::string as_toml(const Values& values);

}  // namespace ols::setup
