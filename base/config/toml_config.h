// Strict configuration tables over toml++: every error names file, line and key.
//
//   ConfigFile file("station.toml");                 // throws ConfigError when it cannot be parsed
//   config::read(station_section(settings), file.root());    // base/config/config_section.h
#pragma once

#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace ols {

// One line: "FILE:LINE: KEY: what is wrong".
class ConfigError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class ConfigTable {
 public:
  ~ConfigTable();
  ConfigTable(ConfigTable&&) noexcept;

  bool exists() const;  // if false, every key is absent
  bool has(std::string_view key) const;
  // Throws ConfigError for the first key that is not in `known`; the error suggests the most
  // similar known key.
  void refuse_unknown(const std::vector<std::string>& known) const;
  // Each getter returns `fallback` if the key is absent. It throws ConfigError if the value has
  // another type, is not finite or is outside least..greatest.
  double number(std::string_view key, double fallback, double least, double greatest);
  std::int64_t integer(std::string_view key, std::int64_t fallback, std::int64_t least,
                       std::int64_t greatest);
  bool boolean(std::string_view key, bool fallback);
  std::string text(std::string_view key, std::string_view fallback);
  // One of `choices`.
  std::string choice(std::string_view key, std::string_view fallback,
                     const std::vector<std::string>& choices);
  // An array of exactly fallback.size() numbers.
  std::vector<double> numbers(std::string_view key, const std::vector<double>& fallback,
                              double least, double greatest);
  std::vector<std::string> texts(std::string_view key, const std::vector<std::string>& fallback);

  // The table of this key; an empty one if the key is absent.
  ConfigTable& table(std::string_view key);
  // The array of tables of this key; an empty one if the key is absent.
  std::vector<ConfigTable*> tables(std::string_view key);

  // An error about this table's key, for the caller's own checks.
  [[nodiscard]] ConfigError error(std::string_view key, std::string_view what) const;

 private:
  friend class ConfigFile;
  struct Impl;
  explicit ConfigTable(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

class ConfigFile {
 public:
  explicit ConfigFile(const std::string& path);
  // Parses a text instead of a file. Errors show `name` instead of the path.
  ConfigFile(std::string_view text, const std::string& name);
  ConfigTable& root() { return *root_; }

 private:
  std::unique_ptr<ConfigTable> root_;
};

}  // namespace ols
