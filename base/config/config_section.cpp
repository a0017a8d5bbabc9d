#include "base/config/config_section.h"

#include <algorithm>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>

#include "base/config/toml_text.h"

namespace ols::config {
namespace {

std::string shown(double value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const auto& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

std::string array(const std::vector<std::string>& values) {
  std::string text = "[";
  return text.append(joined(values)).append("]");
}

std::vector<std::string> toml_texts(std::vector<std::string> words) {
  for (auto& word : words) word = toml_text(word);
  return words;
}

std::string shown(Range range) { return shown(range.min) + " to " + shown(range.max); }

// A default that was converted from another unit.
std::string shown_default(double field, const Unit& unit) { return shown(unit.to_file(field)); }

void read_array(const Section& section, ConfigTable& parent) {
  for (ConfigTable* table : parent.tables(section.name)) read(section.append(), *table);
}

std::string presence_or_default(const Row& row) {
  if (row.presence == Presence::kRequired) return "required";
  if (row.presence == Presence::kWithSection) return "required in this section";
  return row.fallback;
}

// A bar would end the table cell.
std::string cell(const std::string& text) {
  std::string escaped;
  for (const char c : text) escaped.append(c == '|' ? "\\" : "").push_back(c);
  return escaped;
}

std::string full_path(const std::string& path, const std::string& name) {
  return path.empty() || name.empty() ? path + name : path + "." + name;
}

void rows_as_markdown(std::ostream& out, const Section& section) {
  if (section.rows.empty()) return;
  out << "\n| key | default | values | unit | meaning |\n|---|---|---|---|---|\n";
  for (const Row& row : section.rows) {
    out << "| `" << row.key << "` | " << cell(presence_or_default(row)) << " | " << cell(row.values)
        << " | " << row.unit << " | " << cell(row.sentence) << " |\n";
  }
}

using Values = std::map<std::string, std::string>;

constexpr const char* kKind = "kind";

Row kind_row(const Section& section) {
  std::vector<std::string> kinds;
  for (const Section& form : section.forms) kinds.push_back(form.name);
  return word_row(kKind, 0, kinds, section.choose, "Its kind, on which the other keys depend.");
}

Section formed(const Section& section, std::size_t form) {
  Section whole = section.forms.at(form);
  whole.name = section.name;
  whole.sentence = section.sentence;
  whole.rows.insert(whole.rows.begin(), kind_row(section));
  return whole;
}

Section kinds_alone(const Section& section) { return {"", "", {kind_row(section)}}; }

std::size_t form_of(const Section& section, const std::string& kind) {
  const auto form = std::ranges::find(section.forms, kind, &Section::name);
  return form == section.forms.end() ? 0 : static_cast<std::size_t>(form - section.forms.begin());
}

// The section's name in this table: the present or the former one.
std::string name_in(const Section& section, const ConfigTable& parent) {
  if (section.former_name.empty() || !parent.has(section.former_name)) return section.name;
  if (parent.has(section.name)) {
    throw parent.error(section.former_name,
                       "is the former name of " + section.name + ": there may be only one of them");
  }
  return section.former_name;
}

void read_formed(const Section& section, ConfigTable& table, bool former) {
  if (former) {
    section.choose(0);
    return read(section.forms.front(), table);
  }
  kind_row(section).read(table);  // refused before the keys that belong to it
  read(formed(section, form_of(section, table.text(kKind, section.forms.front().name))), table);
}

void read_inner(const Section& inner, ConfigTable& parent) {
  if (inner.append) return read_array(inner, parent);
  const std::string name = name_in(inner, parent);
  ConfigTable& table = parent.table(name);
  inner.forms.empty() ? read(inner, table) : read_formed(inner, table, name != inner.name);
}

bool any_below(const Values& values, const std::string& path) {
  const auto first = values.lower_bound(path + ".");
  return first != values.end() && first->first.starts_with(path + ".");
}

void rows_as_example(std::ostream& out, const Section& section, const std::string& path,
                     Values& values);

// In the form to which the values belong.
void form_as_example(std::ostream& out, const Section& section, const std::string& path,
                     Values& values) {
  const std::string former = full_path(path, section.former_name);
  if (!section.former_name.empty() && any_below(values, former)) {
    Section first = section.forms.front();
    first.sentence = section.sentence;
    return rows_as_example(out, first, former, values);
  }
  const std::string name = full_path(path, section.name);
  const auto kind = values.find(full_path(name, kKind));
  const bool stated = kind != values.end() && kind->second.size() > 2;
  const std::size_t form =
      stated ? form_of(section, kind->second.substr(1, kind->second.size() - 2)) : 0;
  rows_as_example(out, formed(section, form), name, values);
}

void rows_as_example(std::ostream& out, const Section& section, const std::string& path,
                     Values& values) {
  bool headed = path.empty();
  for (const Row& row : section.rows) {
    const auto value = values.extract(full_path(path, row.key));
    if (value.empty()) continue;
    if (!headed) out << "\n[" << path << "]  # " << section.sentence << "\n";
    headed = true;
    out << row.key << " = " << value.mapped() << "  # " << row.sentence << "\n";
  }
  for (const Section& inner : section.sections) {
    inner.forms.empty() ? rows_as_example(out, inner, full_path(path, inner.name), values)
                        : form_as_example(out, inner, path, values);
  }
}

Section pick(const Section& from, const std::string& path, std::set<std::string>& left) {
  Section section{from.name, from.sentence};
  section.former_name = from.former_name;
  for (const Row& row : from.rows) {
    if (left.erase(full_path(path, row.key)) > 0) section.rows.push_back(row);
  }
  for (const Section& inner : from.sections) {
    Section rows = pick(inner, full_path(path, inner.name), left);
    if (!rows.rows.empty() || !rows.sections.empty()) section.sections.push_back(std::move(rows));
  }
  for (const Section& form : from.forms) {
    Section rows = pick(form, path, left);
    std::ranges::move(rows.rows, std::back_inserter(section.rows));
    std::ranges::move(rows.sections, std::back_inserter(section.sections));
  }
  return section;
}

}  // namespace

void read(const Section& section, ConfigTable& table) {
  std::vector<std::string> known;
  for (const Row& row : section.rows) known.push_back(row.key);
  for (const Section& inner : section.sections) {
    known.push_back(inner.name);
    if (!inner.former_name.empty()) known.push_back(inner.former_name);
  }
  table.refuse_unknown(known);
  for (const Row& row : section.rows) {
    const bool wanted = row.presence == Presence::kRequired ||
                        (row.presence == Presence::kWithSection && table.exists());
    if (wanted && !table.has(row.key)) throw table.error(row.key, "is missing");
    row.read(table);
  }
  for (const Section& inner : section.sections) read_inner(inner, table);
  if (section.check) section.check(table);
}

std::string markdown(const Section& section, const std::string& path) {
  std::ostringstream out;
  const std::string name = full_path(path, section.name);
  const Section& shown = section.append ? section.append() : section;
  if (!name.empty()) {
    const std::string brackets = section.append ? "[[" + name + "]]" : "[" + name + "]";
    out << "\n### `" << brackets << "`\n\n" << section.sentence << "\n";
  }
  rows_as_markdown(out, section.forms.empty() ? shown : kinds_alone(section));
  for (const Section& inner : shown.sections) out << markdown(inner, name);
  if (!section.former_name.empty()) {
    out << "\n`[" << full_path(path, section.former_name) << "]` is still read, as `"
        << section.forms.front().name << "`.\n";
  }
  for (const Section& form : section.forms) {
    out << "\n#### `[" << name << "]` with `kind = \"" << form.name << "\"`\n\n"
        << form.sentence << "\n";
    rows_as_markdown(out, form);
    for (const Section& inner : form.sections) out << markdown(inner, name);
  }
  return out.str();
}

std::string example(const Section& root,
                    const std::vector<std::pair<std::string, std::string>>& values) {
  Values left(values.begin(), values.end());
  std::ostringstream out;
  rows_as_example(out, root, "", left);
  if (!left.empty()) throw std::invalid_argument("no row for the key " + left.begin()->first);
  return out.str();
}

Section picked(const Section& root, const std::vector<std::string>& keys) {
  std::set<std::string> left(keys.begin(), keys.end());
  Section rows = pick(root, "", left);
  if (!left.empty()) throw std::invalid_argument("no row for the key " + *left.begin());
  return rows;
}

std::vector<std::string> stated(const Section& section, ConfigTable& table) {
  std::vector<std::string> keys;
  for (const Row& row : section.rows) {
    if (table.has(row.key)) keys.push_back(row.key);
  }
  for (const Section& inner : section.sections) {
    for (const std::string& key : stated(inner, table.table(name_in(inner, table)))) {
      keys.push_back(full_path(inner.name, key));
    }
  }
  return keys;
}

void not_empty(const std::string& text) {
  if (text.empty()) throw std::invalid_argument("must not be empty");
}

Row number(std::string key, double& field, Range range, Unit unit, std::string sentence) {
  const auto read = [&field, key, range, unit](ConfigTable& table) {
    field = unit.to_field(table.number(key, unit.to_file(field), range.min, range.max));
  };
  return {key, shown(range), unit.name, shown_default(field, unit), std::move(sentence), read};
}

Row numbers(std::string key, std::span<double> field, Range range, Unit unit,
            std::string sentence) {
  const auto in_file = [field, unit] {
    std::vector<double> values;
    for (const double value : field) values.push_back(unit.to_file(value));
    return values;
  };
  const auto read = [=](ConfigTable& table) {
    const auto values = table.numbers(key, in_file(), range.min, range.max);
    std::transform(values.begin(), values.end(), field.begin(), unit.to_field);
  };
  std::vector<std::string> fallback;
  for (const double value : in_file()) fallback.push_back(shown(value));
  return {key, shown(range), unit.name, array(fallback), std::move(sentence), read};
}

Row flag(std::string key, bool& field, std::string sentence) {
  const auto read = [&field, key](ConfigTable& table) { field = table.boolean(key, field); };
  return {key, "true, false", "", field ? "true" : "false", std::move(sentence), read};
}

Row text(std::string key, std::string& field, std::string sentence, Check check) {
  const auto read = [&field, key, check](ConfigTable& table) {
    field = table.text(key, field);
    try {
      if (check) check(field);
    } catch (const std::invalid_argument& problem) {
      throw table.error(key, problem.what());
    }
  };
  return {key, "text", "", toml_text(field), std::move(sentence), read};
}

Row texts(std::string key, std::vector<std::string>& field, std::string sentence) {
  const auto read = [&field, key](ConfigTable& table) { field = table.texts(key, field); };
  return {key, "array of texts", "", array(toml_texts(field)), std::move(sentence), read};
}

Row choice(std::string key, std::string& field, std::vector<std::string> choices,
           std::string sentence) {
  const auto read = [&field, key, choices](ConfigTable& table) {
    field = table.choice(key, field, choices);
  };
  return {key, joined(toml_texts(choices)), "", toml_text(field), std::move(sentence), read};
}

Row word_row(std::string key, std::size_t fallback, std::vector<std::string> words,
             std::function<void(std::size_t)> set, std::string sentence) {
  const auto read = [=](ConfigTable& table) {
    const std::string chosen = table.choice(key, words[fallback], words);
    set(static_cast<std::size_t>(std::ranges::find(words, chosen) - words.begin()));
  };
  return {key, joined(toml_texts(words)), "", toml_text(words[fallback]), std::move(sentence),
          read};
}

Row words_row(std::string key, const std::vector<std::size_t>& fallback,
              std::vector<std::string> words, std::function<void(std::vector<std::size_t>)> set,
              std::string sentence) {
  std::vector<std::string> by_default;
  for (const std::size_t i : fallback) by_default.push_back(words[i]);
  const auto read = [=](ConfigTable& table) {
    std::vector<std::size_t> chosen;
    for (const std::string& name : table.texts(key, by_default)) {
      const auto known = std::ranges::find(words, name);
      if (known == words.end())
        throw table.error(key, toml_text(name) + " is not one of " + joined(words));
      const auto i = static_cast<std::size_t>(known - words.begin());
      if (std::ranges::count(chosen, i) != 0)
        throw table.error(key, toml_text(name) + " appears twice");
      chosen.push_back(i);
    }
    if (chosen.empty()) throw table.error(key, "needs at least one entry");
    set(chosen);
  };
  return {key,
          "array of " + joined(toml_texts(words)),
          "",
          array(toml_texts(by_default)),
          std::move(sentence),
          read};
}

Row integer_row(std::string key, std::int64_t fallback, std::int64_t min, std::int64_t max,
                std::string unit, std::function<void(std::int64_t)> set, std::string sentence) {
  const auto read = [=](ConfigTable& table) { set(table.integer(key, fallback, min, max)); };
  const std::string range = max == INT64_MAX
                                ? "integer, " + std::to_string(min) + " or more"
                                : "integer, " + std::to_string(min) + " to " + std::to_string(max);
  return {key, range, std::move(unit), std::to_string(fallback), std::move(sentence), read};
}

Row one_of(std::string key, int& field, std::vector<int> choices, std::string unit,
           std::string sentence) {
  std::vector<std::string> words;
  for (const int value : choices) words.push_back(std::to_string(value));
  const auto read = [&field, key, choices, words](ConfigTable& table) {
    const auto value = table.integer(key, field, INT32_MIN, INT32_MAX);
    if (std::ranges::count(choices, value) == 0)
      throw table.error(key, std::to_string(value) + " is not one of " + joined(words));
    field = static_cast<int>(value);
  };
  return {key, joined(words), std::move(unit), std::to_string(field), std::move(sentence), read};
}

}  // namespace ols::config
