// Parts that the configurations of several programs share: rows, checks, and reading a file.
#pragma once

#include <array>
#include <cstddef>
#include <ranges>
#include <string>
#include <vector>

#include "base/config/config_section.h"

namespace ols::config {

Row bus_url(std::string& field);
Row status_file(std::string& field);

// Maps the words of a table's rows to their values. Each row has a field `name` and a field for the
// value.
template <class Row, class T>
Words<T> words_of(const std::ranges::range auto& rows, T Row::*value) {
  Words<T> words;
  for (const Row& row : rows) words.emplace_back(row.name, row.*value);
  return words;
}

// Letters, digits, - and _: safe in file names, topics and XML.
Check word_up_to(std::size_t longest);
// Checks the order of south, west, north, east. The row itself checks the range of each number.
void check_area(const std::array<double, 4>& area_deg, const char* key, const ConfigTable& table);

// Refuses two elements of an array of tables with the same name.
void check_distinct(const std::vector<std::string>& names, const char* array,
                    const ConfigTable& root);

template <class Config>
Config read(ConfigFile& file, Section (*section)(Config&)) {
  Config config;
  read(section(config), file.root());
  return config;
}

// Throws ConfigError.
template <class Config>
Config load(const std::string& path, Section (*section)(Config&)) {
  ConfigFile file(path);
  return read(file, section);
}

// The same from text. Errors give `name` instead of the path.
template <class Config>
Config parse(const std::string& text, const std::string& name, Section (*section)(Config&)) {
  ConfigFile file(text, name);
  return read(file, section);
}

}  // namespace ols::config
