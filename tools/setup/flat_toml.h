// A TOML text as its values by full key. Pure.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace ols::setup {

// ("pose.latitude_deg", "49.2"): the value as TOML writes it.
using Values = std::vector<std::pair<std::string, std::string>>;

// In the order of their keys. Throws std::runtime_error for a text that is no TOML.
Values flat(const std::string& toml);
// Of one table: what begins with `table` and a dot, without that.
Values of_table(const Values& values, const std::string& table);
// Null if it is not there.
const std::string* find(const Values& values, const std::string& key);
// What a value says that is a text; nothing if it is none.
std::optional<std::string> text_in(const std::string& value);
// What a list of texts says; nothing if it is none.
std::optional<std::vector<std::string>> texts_in(const std::string& value);
// One "key = value" a line.
std::string as_toml(const Values& values);

}  // namespace ols::setup
