#include "conditions/alarm.h"

#include <algorithm>
#include <optional>

namespace ols {
namespace {

using Parameters = std::vector<std::pair<std::string, std::string>>;

// A parameter ends where the words behind it begin. More can follow the sentence.
std::optional<Parameters> match(std::string_view pattern, std::string_view said) {
  Parameters found;
  for (;;) {
    const std::size_t open = pattern.find('{');
    const std::string_view words = pattern.substr(0, open);
    const bool is_rest = !found.empty() && words.empty();
    const std::size_t at = is_rest ? said.size() : said.find(words);
    if (at == std::string_view::npos || (found.empty() && at != 0)) return std::nullopt;
    if (!found.empty()) found.back().second = said.substr(0, at);
    said.remove_prefix(at + words.size());
    if (open == std::string_view::npos) return found;
    const std::size_t close = pattern.find('}', open);
    found.emplace_back(pattern.substr(open + 1, close - open - 1), "");
    pattern.remove_prefix(close + 1);
  }
}

std::pair<const AlarmSentence*, Parameters> find(std::string_view said) {
  for (const AlarmSentence& one : alarm_sentences()) {
    if (auto found = match(one.english, said)) return {&one, std::move(*found)};
  }
  return {nullptr, {}};
}

}  // namespace

Alarm alarm_of(std::string_view sentence) {
  auto [known, parameters] = find(sentence);
  return known ? Alarm{std::string(known->id), std::move(parameters)} : Alarm{};
}

std::string alarm_key(const std::string& sentence) {
  const auto [known, parameters] = find(sentence);
  if (!known) return sentence;
  std::string key(known->id);
  for (const auto& [name, value] : parameters) {
    const bool is_subject = known->subject.find(" " + name + " ") != std::string_view::npos;
    if (is_subject) key.append(" ").append(value);
  }
  return key;
}

}  // namespace ols
