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

}  // namespace

std::string said_behind(std::string_view words, std::string_view sentence) {
  const std::size_t at = sentence.find(words);
  return std::string(at == std::string_view::npos ? sentence : sentence.substr(at + words.size()));
}

Alarm alarm_of(std::string_view sentence) {
  for (const AlarmSentence& one : alarm_sentences()) {
    if (auto found = match(one.english, sentence)) {
      return {std::string(sentence), std::string(one.id), std::move(*found)};
    }
  }
  return {std::string(sentence), {}, {}};
}

std::vector<Alarm> alarms_of(const std::vector<std::string>& sentences) {
  std::vector<Alarm> alarms;
  for (const std::string& sentence : sentences) alarms.push_back(alarm_of(sentence));
  return alarms;
}

const AlarmSentence& Alarm::row() const {
  static constexpr AlarmSentence kUnknown{{}, {}, {}, "warning", "docs/troubleshooting.md"};
  const auto known = std::ranges::find(alarm_sentences(), id, &AlarmSentence::id);
  return known == alarm_sentences().end() ? kUnknown : *known;
}

std::string Alarm::key() const {
  if (id.empty()) return text;
  std::string key = id;
  for (const auto& [name, value] : parameters) {
    if (is_subject(name)) key.append(" ").append(value);
  }
  return key;
}

std::string Alarm::gist() const {
  if (row().id.empty()) return text;
  std::string gist(row().english);
  for (const auto& [name, value] : parameters) {
    const std::string place = "{" + name + "}";
    const std::size_t at = gist.find(place);
    if (at != std::string::npos) gist.replace(at, place.size(), is_subject(name) ? value : "…");
  }
  return gist;
}

}  // namespace ols
