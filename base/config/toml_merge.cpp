#include "base/config/toml_merge.h"

#include <toml++/toml.h>

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <vector>

namespace ols {
namespace {

// A text by lines, as the parser counts them: from 1.
class Lines {
 public:
  explicit Lines(const std::string& text) {
    for (std::size_t begin = 0; begin < text.size();) {
      const std::size_t end = std::min(text.find('\n', begin), text.size());
      lines_.push_back(text.substr(begin, end - begin));
      begin = end + 1;
    }
  }
  std::string cut(const toml::source_region& place) const {
    return line(place.begin.line).substr(place.begin.column - 1, length(place));
  }
  char character(const toml::source_position& at) const { return line(at.line).at(at.column - 1); }
  void replace(const toml::source_region& place, const std::string& with) {
    lines_.at(place.begin.line - 1).replace(place.begin.column - 1, length(place), with);
  }
  void insert_after(std::size_t number, const std::string& line) {
    lines_.insert(lines_.begin() + static_cast<std::ptrdiff_t>(number), line);
  }
  void append(const std::string& line) { lines_.push_back(line); }
  std::string text() const {
    std::string all;
    for (const std::string& line : lines_) all += line + '\n';
    return all;
  }

 private:
  const std::string& line(std::size_t number) const { return lines_.at(number - 1); }
  // The values that are changed are numbers: they are in one line.
  static std::size_t length(const toml::source_region& place) {
    return place.end.column - place.begin.column;
  }

  std::vector<std::string> lines_;
};

// The last line of a table's own values, or of its header if it has none.
std::size_t last_line(const toml::table& table) {
  std::size_t last = table.source().begin.line;
  for (const auto& [key, node] : table) {
    if (!node.is_table()) last = std::max<std::size_t>(last, node.source().end.line);
  }
  return last;
}

// Whether a table has no header of its own, only those of tables within it: [calibration.sd] alone
// makes a table `calibration`.
bool is_implied(const toml::table& table, const Lines& lines) {
  const toml::source_position at = table.source().begin;
  const bool is_header = at && lines.character(at) == '[';
  return is_header && std::ranges::any_of(table, [&](const auto& entry) {
           return entry.second.is_table() && entry.second.source().begin == at;
         });
}

std::string with_value(const std::string& text, const std::string& table_path,
                       const std::string& key, const std::string& value) {
  const toml::table root = toml::parse(text);
  const auto table =
      table_path.empty() ? toml::node_view<const toml::node>(root) : root.at_path(table_path);
  Lines lines(text);
  if (const toml::node* old = table[key].node()) {
    lines.replace(old->source(), value);
  } else if (table.is_table() && !is_implied(*table.as_table(), lines)) {
    lines.insert_after(last_line(*table.as_table()), key + " = " + value);
  } else {
    lines.append("");
    lines.append("[" + table_path + "]");
    lines.append(key + " = " + value);
  }
  return lines.text();
}

// The values that `table` must have after the change.
void set_values(toml::table& table, const toml::table& changes) {
  for (const auto& change : changes) {
    const toml::key& key = change.first;  // a structured binding cannot be captured below
    const toml::node& node = change.second;
    if (const toml::table* inner = node.as_table()) {
      auto& own = *table.insert(key, toml::table{}).first->second.as_table();
      set_values(own, *inner);
    } else {
      node.visit([&](const auto& value) { table.insert_or_assign(key, value); });
    }
  }
}

std::string merge_table(std::string text, const std::string& path, const toml::table& changes,
                        const Lines& changed) {
  for (const auto& [key, node] : changes) {
    const std::string name(key.str());
    if (const toml::table* inner = node.as_table()) {
      text = merge_table(text, path.empty() ? name : path + "." + name, *inner, changed);
      continue;
    }
    text = with_value(text, path, name, changed.cut(node.source()));
  }
  return text;
}

}  // namespace

std::string toml_merged(const std::string& text, const std::string& changes) {
  const toml::table wanted = toml::parse(changes);
  toml::table expected = toml::parse(text);
  set_values(expected, wanted);
  const std::string merged = merge_table(text, "", wanted, Lines(changes));
  if (toml::parse(merged) != expected) {
    throw std::runtime_error("its tables cannot be changed separately: write the values by hand");
  }
  return merged;
}

}  // namespace ols
