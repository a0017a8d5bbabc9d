// What the configurations of several programs have in common: rows, checks, and how a file is read.
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

// Makes the words and values of a choice from an array of structures. The word is the structure's
// field `name`; `value` points to the field with the value.
template <class Row, class T>
Words<T> words_of(const std::ranges::range auto& rows, T Row::*value) {
  Words<T> words;
  for (const Row& row : rows) words.emplace_back(row.name, row.*value);
  return words;
}

// Accepts 1 to `longest` letters, digits, - and _. Such a word is safe in file names, topics and
// XML.
Check word_up_to(std::size_t longest);
// Throws ConfigError unless south is at most north and both are within 90 degrees. West may be
// greater than east (base/config/area.h).
void check_area(const std::array<double, 4>& area_deg, const char* key, const ConfigTable& table);

// Throws ConfigError if two elements of an array of tables have the same name.
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

// Parses a text instead of a file. Errors show `name` instead of the path.
template <class Config>
Config parse(const std::string& text, const std::string& name, Section (*section)(Config&)) {
  ConfigFile file(text, name);
  return read(file, section);
}

}  // namespace ols::config
