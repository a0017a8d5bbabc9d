#include "conditions/alarm.h"

#include <span>

#include "conditions/alarm_rows.h"
#include "conditions/refusal.h"

namespace ols {
namespace {

constexpr std::string_view kAbout = ": ";
constexpr std::string_view kReason = "reason";  // a parameter: a reason of the table

// `pattern` with a value in the place of each {parameter}.
template <class Value>
std::string filled(std::string_view pattern, const Value& value_of) {
  std::string text;
  for (;;) {
    const std::size_t open = pattern.find('{');
    text += pattern.substr(0, open);
    if (open == std::string_view::npos) return text;
    const std::size_t close = pattern.find('}', open);
    text += value_of(pattern.substr(open + 1, close - open - 1));
    pattern.remove_prefix(close + 1);
  }
}

bool is_subject(const AlarmRow& row, std::string_view parameter) {
  return row.subject.find(" " + std::string(parameter) + " ") != std::string_view::npos;
}

}  // namespace

Alarm raise(std::string_view id, Alarm::Parameters parameters) {
  Alarm alarm{{}, std::string(id), std::move(parameters)};
  alarm.text = filled(alarm.row().english, [&](auto name) {
    return name == kReason ? refusal_words(alarm.parameter(name)) : alarm.parameter(name);
  });
  return alarm;
}

std::vector<Alarm> alarms_of(const std::vector<std::string>& sentences) {
  std::vector<Alarm> alarms;
  for (const std::string& sentence : sentences) alarms.push_back({sentence, {}, {}});
  return alarms;
}

Alarm Alarm::with_detail(const std::string& detail) const {
  Alarm alarm = *this;
  alarm.text += ": " + detail;
  alarm.parameters.emplace_back("detail", detail);
  return alarm;
}

const AlarmRow& Alarm::row() const {
  static constexpr AlarmRow kUnknown{{}, {}, {}, "warning", "docs/troubleshooting.md"};
  const auto known = std::ranges::find(alarm_rows(), id, &AlarmRow::id);
  return known == alarm_rows().end() ? kUnknown : *known;
}

std::string Alarm::parameter(std::string_view name) const {
  for (const auto& [known, value] : parameters) {
    if (known == name) return value;
  }
  return {};
}

std::string Alarm::key() const {
  if (id.empty()) return text;
  std::string key = id;
  for (const auto& [name, value] : parameters) {
    if (is_subject(row(), name)) key.append(" ").append(value);
  }
  return key;
}

std::string Alarm::gist() const {
  if (row().id.empty()) return text;
  return filled(row().english,
                [this](auto name) { return is_subject(row(), name) ? parameter(name) : "…"; });
}

std::string Alarm::part() const {
  const std::size_t colon = row().english.find(kAbout);
  if (colon == std::string_view::npos) return {};
  return filled(row().english.substr(0, colon), [this](auto name) { return parameter(name); });
}

std::string Alarm::reason() const {
  const std::string about = part();
  return about.empty() ? text : text.substr(std::min(text.size(), about.size() + kAbout.size()));
}

}  // namespace ols
