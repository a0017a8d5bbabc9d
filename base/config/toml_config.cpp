#include "base/config/toml_config.h"

#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

namespace ols {
namespace {

struct Document {
  std::string name;
  toml::table table;
};

std::string number_text(double value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

std::string range_text(double least, double greatest) {
  return number_text(least) + ".." + number_text(greatest);
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const auto& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

// Optimal string alignment distance: letters inserted, left out, replaced, or two swapped.
std::size_t edits(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) {
    for (std::size_t j = 0; j <= b.size(); ++j) {
      d[i][j] = i == 0 || j == 0 ? i + j
                                 : std::min({d[i - 1][j] + 1, d[i][j - 1] + 1,
                                             d[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  }
  return d[a.size()][b.size()];
}

// The known key that was probably meant: at most a third of its letters differ. Empty: none.
std::string most_similar(std::string_view key, const std::vector<std::string>& known) {
  constexpr std::size_t kLongest = 64;  // longer keys are not worth a guess
  std::string best;
  std::size_t fewest = key.size() / 3 + 1;
  for (const std::string& candidate : known) {
    if (key.size() > kLongest || edits(key, candidate) >= fewest) continue;
    fewest = edits(key, candidate);
    best = candidate;
  }
  return best;
}

std::shared_ptr<const Document> parse(std::string_view text, const std::string& name) {
  try {
    return std::make_shared<const Document>(Document{name, toml::parse(text, name)});
  } catch (const toml::parse_error& error) {
    std::ostringstream line;
    line << name << ':' << error.source().begin.line << ": " << error.description();
    throw ConfigError(line.str());
  }
}

std::string file_text(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  // To a stream an empty file is a failure, but it is a valid configuration without keys.
  if (in && in.peek() == std::ifstream::traits_type::eof() && !in.bad()) return {};
  if (!in || !(text << in.rdbuf())) throw ConfigError(path + ": cannot be read");
  return text.str();
}

}  // namespace

struct ConfigTable::Impl {
  std::shared_ptr<const Document> document;
  const toml::table* table = nullptr;  // null: the table is absent
  std::string path;                    // "ptu.servo."; empty at the root
  std::map<std::string, std::unique_ptr<ConfigTable>, std::less<>> children;
  std::map<std::string, std::vector<std::unique_ptr<ConfigTable>>, std::less<>> arrays;

  const toml::node* find(std::string_view key) const {
    return table == nullptr ? nullptr : table->get(key);
  }

  ConfigError error_in(toml::source_index line, std::string_view key, std::string_view what) const {
    std::ostringstream text;
    text << document->name << ':';
    if (line > 0) text << line << ':';
    text << ' ' << path << key << ": " << what;
    return ConfigError(text.str());
  }

  ConfigError error_at(const toml::node* node, std::string_view key, std::string_view what) const {
    if (node == nullptr) node = table;
    return error_in(node == nullptr ? 0 : node->source().begin.line, key, what);
  }

  double checked(const toml::node* node, std::string_view key, double least, double greatest) {
    const auto value = node->value<double>();
    if (!node->is_number() || !value) throw error_at(node, key, "must be a number");
    if (!std::isfinite(*value)) throw error_at(node, key, "must be finite");
    if (*value < least || *value > greatest) {
      throw error_at(node, key, number_text(*value) + " is outside " + range_text(least, greatest));
    }
    return *value;
  }

  std::unique_ptr<ConfigTable> child(const toml::table* node, const std::string& child_path) const {
    auto impl = std::make_unique<Impl>();
    impl->document = document;
    impl->table = node;
    impl->path = child_path;
    return std::unique_ptr<ConfigTable>(new ConfigTable(std::move(impl)));
  }
};

ConfigTable::ConfigTable(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
ConfigTable::~ConfigTable() = default;
ConfigTable::ConfigTable(ConfigTable&&) noexcept = default;

bool ConfigTable::exists() const { return impl_->table != nullptr; }

bool ConfigTable::has(std::string_view key) const { return impl_->find(key) != nullptr; }

void ConfigTable::refuse_unknown(const std::vector<std::string>& known) const {
  if (!exists()) return;
  for (const auto& [key, node] : *impl_->table) {
    if (std::ranges::find(known, key.str()) != known.end()) continue;
    const std::string meant = most_similar(key.str(), known);
    throw impl_->error_in(key.source().begin.line, key.str(),
                          "unknown key" + (meant.empty() ? "" : "; did you mean " + meant + "?"));
  }
}

double ConfigTable::number(std::string_view key, double fallback, double least, double greatest) {
  const auto* node = impl_->find(key);
  return node == nullptr ? fallback : impl_->checked(node, key, least, greatest);
}

std::int64_t ConfigTable::integer(std::string_view key, std::int64_t fallback, std::int64_t least,
                                  std::int64_t greatest) {
  const auto* node = impl_->find(key);
  if (node == nullptr) return fallback;
  if (!node->is_integer()) throw impl_->error_at(node, key, "must be an integer");
  const std::int64_t value = node->as_integer()->get();
  if (value < least || value > greatest) {
    throw impl_->error_at(node, key,
                          std::to_string(value) + " is outside " + std::to_string(least) + ".." +
                              std::to_string(greatest));
  }
  return value;
}

bool ConfigTable::boolean(std::string_view key, bool fallback) {
  const auto* node = impl_->find(key);
  if (node == nullptr) return fallback;
  if (!node->is_boolean()) throw impl_->error_at(node, key, "must be true or false");
  return node->as_boolean()->get();
}

std::string ConfigTable::text(std::string_view key, std::string_view fallback) {
  const auto* node = impl_->find(key);
  if (node == nullptr) return std::string(fallback);
  if (!node->is_string()) throw impl_->error_at(node, key, "must be a string");
  return node->as_string()->get();
}

std::string ConfigTable::choice(std::string_view key, std::string_view fallback,
                                const std::vector<std::string>& choices) {
  std::string value = text(key, fallback);
  if (std::find(choices.begin(), choices.end(), value) == choices.end()) {
    throw error(key, "\"" + value + "\" is not one of " + joined(choices));
  }
  return value;
}

std::vector<double> ConfigTable::numbers(std::string_view key, const std::vector<double>& fallback,
                                         double least, double greatest) {
  const auto* node = impl_->find(key);
  if (node == nullptr) return fallback;
  const auto* array = node->as_array();
  if (array == nullptr || array->size() != fallback.size()) {
    throw impl_->error_at(node, key,
                          "must be an array of " + std::to_string(fallback.size()) + " numbers");
  }
  std::vector<double> values;
  for (const auto& element : *array) {
    values.push_back(impl_->checked(&element, key, least, greatest));
  }
  return values;
}

std::vector<std::string> ConfigTable::texts(std::string_view key,
                                            const std::vector<std::string>& fallback) {
  const auto* node = impl_->find(key);
  if (node == nullptr) return fallback;
  const auto* array = node->as_array();
  if (array == nullptr) throw impl_->error_at(node, key, "must be an array of strings");
  std::vector<std::string> values;
  for (const auto& element : *array) {
    if (!element.is_string()) throw impl_->error_at(&element, key, "must be a string");
    values.push_back(element.as_string()->get());
  }
  return values;
}

ConfigTable& ConfigTable::table(std::string_view key) {
  auto known = impl_->children.find(key);
  if (known != impl_->children.end()) return *known->second;
  const auto* node = impl_->find(key);
  if (node != nullptr && !node->is_table()) throw impl_->error_at(node, key, "must be a table");
  const toml::table* found = node == nullptr ? nullptr : node->as_table();
  auto child = impl_->child(found, impl_->path + std::string(key) + ".");
  return *impl_->children.emplace(std::string(key), std::move(child)).first->second;
}

std::vector<ConfigTable*> ConfigTable::tables(std::string_view key) {
  auto& children = impl_->arrays[std::string(key)];
  const auto* node = impl_->find(key);
  if (children.empty() && node != nullptr) {
    const auto* array = node->as_array();
    if (array == nullptr) throw impl_->error_at(node, key, "must be an array of tables");
    for (const auto& element : *array) {
      if (!element.is_table()) throw impl_->error_at(&element, key, "must be a table");
      const auto index = std::to_string(children.size());
      children.push_back(
          impl_->child(element.as_table(), impl_->path + std::string(key) + "[" + index + "]."));
    }
  }
  std::vector<ConfigTable*> result;
  for (const auto& child : children) result.push_back(child.get());
  return result;
}

ConfigError ConfigTable::error(std::string_view key, std::string_view what) const {
  const auto* node = impl_->table == nullptr ? nullptr : impl_->table->get(key);
  return impl_->error_at(node, key, what);
}

ConfigFile::ConfigFile(const std::string& path) : ConfigFile(file_text(path), path) {}

ConfigFile::ConfigFile(std::string_view text, const std::string& name) {
  auto impl = std::make_unique<ConfigTable::Impl>();
  impl->document = parse(text, name);
  impl->table = &impl->document->table;
  root_.reset(new ConfigTable(std::move(impl)));
}

}  // namespace ols
