// Describes a section of a configuration file as one table. Each row binds a key to its field, its
// range, its unit and the sentence that explains it. The rows serve to read the file, and to write
// docs/configuration.md and the example files.
//
//   config::Section servo_section(ServoConfig& c) {
//     return {"servo", "How the unit follows its goal.",
//             {config::number("gain_hz", c.gain_hz, {0.1, 10.0}, "1/s", "Gain on the angle
//             error.")}};
//   }
//   config::read(servo_section(c), table);  // the fields keep their defaults where keys are absent
#pragma once

#include <concepts>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/config/toml_config.h"

namespace ols::config {

struct Range {
  double min, max;
};

// The unit in the file. If the field has another unit, values are converted both ways.
struct Unit {
  std::string name;
  double (*to_field)(double) = [](double value) { return value; };
  double (*to_file)(double) = [](double value) { return value; };

  Unit(const char* unit) : name(unit) {}  // NOLINT: a plain name converts nothing
  Unit(const char* unit, double (*field)(double), double (*file)(double))
      : name(unit), to_field(field), to_file(file) {}
};
inline const Unit kMegabytes{"MB", [](double v) { return 1e6 * v; },
                             [](double v) { return v * 1e-6; }};
inline const Unit kGigabytes{"GB", [](double v) { return 1e9 * v; },
                             [](double v) { return v * 1e-9; }};
inline const Unit kMilliseconds{"ms", [](double v) { return 1e-3 * v; },
                                [](double v) { return 1e3 * v; }};

enum class Presence {
  kOptional,
  kRequired,
  kWithSection,  // required if its section is present
};

struct Row {
  std::string key, values, unit;  // values: the range or the choices
  std::string fallback;           // the default, as a file would state it
  std::string sentence;
  std::function<void(ConfigTable&)> read;
  Presence presence = Presence::kOptional;

  Row required() && { return with(Presence::kRequired); }
  Row required_with_section() && { return with(Presence::kWithSection); }
  // Use if the default depends on other values: the documentation then shows these words.
  Row default_is(std::string words) && {
    fallback = std::move(words);
    return std::move(*this);
  }

 private:
  Row with(Presence wanted) {
    presence = wanted;
    return std::move(*this);
  }
};

struct Section {
  std::string name;
  std::string sentence;
  std::vector<Row> rows = {};
  std::vector<Section> sections = {};
  // A check that concerns several rows; throws ConfigError. Runs after rows and sections are read.
  std::function<void(ConfigTable&)> check = {};
  // For an array of tables: appends an element to it and returns the element's section.
  std::function<Section()> append = {};
  // For a section whose other keys depend on its key `kind`: one form for each kind. The name of a
  // form is the value of `kind`; the first form is the default. `choose` gets the index of the form
  // that is read.
  std::vector<Section> forms = {};
  std::function<void(std::size_t)> choose = {};
  // An older name of the section. A section of this name is still read, as the first form.
  std::string former_name = {};
};

// Throws ConfigError for the first unknown key, missing key or bad value.
void read(const Section& section, ConfigTable& table);
// Markdown: a heading and a table for the section and each nested one. `path`: the path of the
// parent section.
std::string markdown(const Section& section, const std::string& path = "");
// An example file with these keys and values ("mount.baud" -> "9600"), in the order of the
// sections, each with the sentence of its row. If a key uses a section's former name, so does the
// file. Throws std::invalid_argument for a key that has no row.
std::string example(const Section& root,
                    const std::vector<std::pair<std::string, std::string>>& values);

// The section with only the rows of these keys ("ptu.baud"), without the checks across rows. Throws
// std::invalid_argument for a key that has no row.
Section picked(const Section& root, const std::vector<std::string>& keys);
// The keys of the section that the file states.
std::vector<std::string> stated(const Section& section, ConfigTable& table);

using Check = std::function<void(const std::string&)>;  // throws std::invalid_argument
void not_empty(const std::string& text);

Row number(std::string key, double& field, Range range, Unit unit, std::string sentence);
Row numbers(std::string key, std::span<double> field, Range range, Unit unit, std::string sentence);
Row flag(std::string key, bool& field, std::string sentence);
Row text(std::string key, std::string& field, std::string sentence, Check check = {});
Row texts(std::string key, std::vector<std::string>& field, std::string sentence);
Row choice(std::string key, std::string& field, std::vector<std::string> choices,
           std::string sentence);

// For the templates below. word_row() reads one of several words and passes its index to `set`;
// words_row() does so for a list of words. integer_row() reads an integer. one_of() is a row for an
// integer that must be one of `choices`.
Row word_row(std::string key, std::size_t fallback, std::vector<std::string> words,
             std::function<void(std::size_t)> set, std::string sentence);
Row words_row(std::string key, const std::vector<std::size_t>& fallback,
              std::vector<std::string> words, std::function<void(std::vector<std::size_t>)> set,
              std::string sentence);
Row integer_row(std::string key, std::int64_t fallback, std::int64_t min, std::int64_t max,
                std::string unit, std::function<void(std::int64_t)> set, std::string sentence);
Row one_of(std::string key, int& field, std::vector<int> choices, std::string unit,
           std::string sentence);

template <class T>
using Words = std::vector<std::pair<const char*, T>>;

template <class T>
std::vector<std::string> names(const Words<T>& words) {
  std::vector<std::string> result;
  for (const auto& [name, value] : words) result.emplace_back(name);
  return result;
}
template <class T>
std::size_t position(const Words<T>& words, const T& value) {
  std::size_t i = 0;
  while (i + 1 < words.size() && !(words[i].second == value)) ++i;
  return i;
}

template <std::integral T>
Row integer(std::string key, T& field, std::int64_t min, std::int64_t max, std::string unit,
            std::string sentence) {
  return integer_row(
      std::move(key), static_cast<std::int64_t>(field), min, max, std::move(unit),
      [&field](std::int64_t value) { field = static_cast<T>(value); }, std::move(sentence));
}

// A row for a field of any type, with a word for each value.
template <class T>
Row word(std::string key, T& field, const Words<std::type_identity_t<T>>& words,
         std::string sentence) {
  return word_row(
      std::move(key), position(words, field), names(words),
      [&field, words](std::size_t i) { field = words[i].second; }, std::move(sentence));
}

// A row for a list of such words: at least one, without duplicates.
template <class T>
Row word_list(std::string key, std::vector<T>& field, const Words<std::type_identity_t<T>>& words,
              std::string sentence) {
  std::vector<std::size_t> fallback;
  for (const T& value : field) fallback.push_back(position(words, value));
  return words_row(
      std::move(key), fallback, names(words),
      [&field, words](const std::vector<std::size_t>& chosen) {
        field.clear();
        for (const std::size_t i : chosen) field.push_back(words[i].second);
      },
      std::move(sentence));
}

}  // namespace ols::config
