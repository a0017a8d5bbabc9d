#include "tools/doctor/secrets.h"

#include <toml++/toml.h>

#include <algorithm>
#include <map>
#include <regex>
#include <sstream>

namespace ols::doctor {
namespace {

constexpr const char* kRemoved = "[removed]";
constexpr auto kFlags = std::regex::ECMAScript | std::regex::icase | std::regex::optimize;

// What a secret's name has in it.
constexpr const char* kWord =
    "(?:key|seed|secret|pass(?:word|wd|code|phrase)?(?!ed|es|ing|age)|pwd|psk|phrase|token|"
    "invitation|credential|authorization|bearer|cookie)";

bool is_secret_name(const std::string& name) {
  static const std::regex kName(kWord, kFlags);
  return std::regex_search(name, kName);
}

// The name, and what stands between it and the value. Behind = or : anything is a value; behind
// blanks alone the name must end in the word itself ("--password X", "key 0 X").
const std::regex& name_and_sign() {
  static const std::regex kNamed(
      std::string(kWord) + R"((?:[-\w.]*["'\])]*\s*[=:>]+|s?(?:[-_.\d][-\w.]*)?["'\])]*\s)\s*)",
      kFlags);
  return kNamed;
}

std::string without_unnamed(const std::string& line) {
  static const std::regex kHex(R"([0-9a-f]{24,})", kFlags);
  static const std::regex kStored(R"(\$[-\w]+\$\S+)", kFlags);  // crypt(3), argon2
  static const std::regex kUrl(R"((\w:/{2})[^/\s]*@)", kFlags);
  std::string result = std::regex_replace(line, kHex, kRemoved);
  result = std::regex_replace(result, kStored, kRemoved);
  return std::regex_replace(result, kUrl, std::string("$1") + kRemoved + "@");
}

// What ends a value that begins in this line and goes on behind it; empty: the value ends here.
std::string end_awaited(const std::string& value) {
  for (const std::string quote : {"\"\"\"", "'''"}) {
    if (value.starts_with(quote)) return value.find(quote, 3) == value.npos ? quote : "";
  }
  static const std::map<char, char> kEnds{
      {'"', '"'}, {'\'', '\''}, {'[', ']'}, {'{', '}'}, {'(', ')'}};
  const auto end = value.empty() ? kEnds.end() : kEnds.find(value.front());
  if (end == kEnds.end()) return value.ends_with('\\') ? "\n" : "";
  for (std::size_t i = 1; i < value.size(); ++i) {
    if (value[i] == '\\')
      ++i;
    else if (value[i] == end->second)
      return "";
  }
  return {end->second};
}

// Line by line; remembers what a line leaves open.
class Cleaner {
 public:
  std::string clean(const std::string& line) {
    if (!awaited_.empty()) {
      const bool is_over =
          awaited_ == "\n" ? !line.ends_with('\\') : line.find(awaited_) != line.npos;
      if (is_over) awaited_.clear();
      return "";
    }
    std::smatch name;
    const std::string first = line.substr(0, kLongestLine);
    if (!std::regex_search(first, name, name_and_sign())) return without_unnamed(first);
    const auto value = static_cast<std::size_t>(name.position() + name.length());
    awaited_ = end_awaited(line.substr(value));
    return without_unnamed(first.substr(0, value)) + kRemoved;
  }

 private:
  std::string awaited_;
};

// Where the values of secret names begin, and the lines that they go on in. Lines and columns count
// from 1.
struct SecretPlaces {
  std::map<std::size_t, std::size_t> columns;  // of the first in each line
  std::map<std::size_t, std::size_t> more;     // first and last line of what goes on

  void note(const toml::source_region& place) {
    const auto known = columns.try_emplace(place.begin.line, place.begin.column).first;
    known->second = std::min<std::size_t>(known->second, place.begin.column);
    if (place.end.line > place.begin.line) {
      std::size_t& last = more[place.begin.line + 1];
      last = std::max<std::size_t>(last, place.end.line);
    }
  }
  void look(const toml::node& node, bool is_secret) {
    if (const toml::table* table = node.as_table()) {
      for (const auto& [key, value] : *table) {
        look(value, is_secret || is_secret_name(std::string(key.str())));
      }
    } else if (is_secret) {
      note(node.source());
    } else if (const toml::array* array = node.as_array()) {
      for (const toml::node& one : *array) look(one, false);
    }
  }
  bool is_inside(std::size_t line) const {
    return std::ranges::any_of(
        more, [line](const auto& m) { return m.first <= line && line <= m.second; });
  }
};

// The first `count` characters of UTF-8.
std::string first_characters(const std::string& text, std::size_t count) {
  std::size_t end = 0;
  for (; end < text.size(); ++end) {
    const bool begins = (static_cast<unsigned char>(text[end]) & 0xC0U) != 0x80U;
    if (begins && count-- == 0) break;
  }
  return text.substr(0, end);
}

}  // namespace

std::string without_secrets(const std::string& text) {
  std::istringstream lines(text);
  std::string result;
  Cleaner cleaner;
  bool in_key = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.find("-----BEGIN") != std::string::npos && line.find("PRIVATE") != std::string::npos) {
      in_key = true;
      result.append(kRemoved).append("\n");
    }
    const bool ends = line.find("-----END") != std::string::npos;
    if (!in_key) result += cleaner.clean(line) + "\n";
    if (ends) in_key = false;
  }
  return result;
}

std::string without_secrets_of_toml(const std::string& text) {
  SecretPlaces places;
  try {
    places.look(toml::parse(text), false);
  } catch (const toml::parse_error& error) {
    return "not TOML, and so not shown: line " + std::to_string(error.source().begin.line) +
           ", column " + std::to_string(error.source().begin.column) + "\n";
  }
  std::istringstream lines(text);
  std::string result;
  std::size_t number = 1;
  for (std::string line; std::getline(lines, line); ++number) {
    const auto secret = places.columns.find(number);
    if (places.is_inside(number)) {
      line.clear();  // what stands behind the value, too
    } else if (secret != places.columns.end()) {
      line = first_characters(line, secret->second - 1) + kRemoved;
    }
    result += line + "\n";
  }
  return without_secrets(result);
}

}  // namespace ols::doctor
