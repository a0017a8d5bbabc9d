#include "tools/setup/flat_toml.h"

#include <toml++/toml.h>

#include <array>
#include <charconv>
#include <sstream>
#include <stdexcept>

namespace ols::setup {
namespace {

// The shortest digits that give the same number: 49.2, not 49.200000000000003.
std::string shown(double number) {
  std::array<char, 40> room{};
  const auto end = std::to_chars(room.data(), room.data() + room.size(), number).ptr;
  std::string text(room.data(), end);
  const bool is_float = text.find_first_of(".en") != std::string::npos;
  return is_float ? text : text + ".0";
}

std::string shown(const toml::node& node) {
  if (const auto number = node.value_exact<double>()) return shown(*number);
  std::ostringstream out;
  node.visit([&out](const auto& value) {
    out << toml::toml_formatter{value, toml::format_flags::quote_dates_and_times};
  });
  return out.str();
}

void flatten(const toml::table& table, const std::string& path, Values& values) {
  for (const auto& [key, node] : table) {
    const std::string full = path + std::string(key.str());
    if (const toml::table* inner = node.as_table()) {
      flatten(*inner, full + ".", values);
    } else {
      values.emplace_back(full, shown(node));
    }
  }
}

}  // namespace

Values flat(const std::string& toml) {
  Values values;
  try {
    flatten(toml::parse(toml), "", values);
  } catch (const toml::parse_error& error) {
    throw std::runtime_error(std::string(error.description()));
  }
  return values;
}

Values of_table(const Values& values, const std::string& table) {
  Values inner;
  for (const auto& [key, value] : values) {
    if (key.starts_with(table + ".")) inner.emplace_back(key.substr(table.size() + 1), value);
  }
  return inner;
}

const std::string* find(const Values& values, const std::string& key) {
  for (const auto& [known, value] : values) {
    if (known == key) return &value;
  }
  return nullptr;
}

std::optional<std::string> text_in(const std::string& value) {
  if (value.empty()) return std::nullopt;
  return toml::parse("x = " + value)["x"].value_exact<std::string>();
}

std::optional<std::vector<std::string>> texts_in(const std::string& value) {
  if (value.empty()) return std::nullopt;
  const toml::table table = toml::parse("x = " + value);
  const toml::array* list = table["x"].as_array();
  if (list == nullptr) return std::nullopt;
  std::vector<std::string> texts;
  for (const toml::node& node : *list) {
    const auto text = node.value_exact<std::string>();
    if (!text) return std::nullopt;
    texts.push_back(*text);
  }
  return texts;
}

std::string as_toml(const Values& values) {
  std::string text;
  for (const auto& [key, value] : values) text.append(key).append(" = ").append(value).append("\n");
  return text;
}

}  // namespace ols::setup
