// An alarm: a row of conditions.toml, with values for the row's parameters. The functions of
// conditions/alarms.h make alarms. Pure.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ols {

// A row of conditions.toml.
struct AlarmRow {
  std::string_view id;
  std::string_view english;   // "ptu: supply voltage low ({volts} V)"
  std::string_view subject;   // the parameters in Alarm::key(): " station axis "
  std::string_view severity;  // "urgent", "warning", "notice"
  std::string_view action;    // what a person should do
};

struct Alarm {
  using Parameters = std::vector<std::pair<std::string, std::string>>;  // name, value

  std::string text{};  // the sentence in English
  std::string id{};    // id of its row; empty in old logs, whose messages had no ids
  Parameters parameters{};

  bool empty() const { return text.empty(); }  // true: there is no alarm
  operator const std::string&() const { return text; }
  bool operator==(const Alarm&) const = default;
  friend bool operator==(const Alarm& alarm, std::string_view text) { return alarm.text == text; }

  // The same alarm with the message of a device or library. The message is appended to the
  // sentence, and becomes the parameter "detail".
  Alarm with_detail(const std::string& detail) const;
  // A key that stays the same while the alarm is active: the id and the values of the subject's
  // parameters ("station_silent s1"). Other parameters may change meanwhile. Without an id: the
  // sentence.
  std::string key() const;
  // The sentence, in which only the subject's parameters have values; all others appear as "…".
  std::string gist() const;
  // The sentence in two parts, split at the first colon of the row's sentence. part() is the text
  // before the colon: it says what the alarm is about ("ptu"). reason() is the rest. Without an id,
  // part() is empty and reason() is the whole sentence.
  std::string part() const;
  std::string reason() const;
  // The value of a parameter; empty: the alarm has no parameter of this name.
  std::string parameter(std::string_view name) const;
  // The alarm's row, with severity and action. Without an id: a row with severity "warning" and an
  // action that refers to docs/troubleshooting.md.
  const AlarmRow& row() const;
};

// Makes the alarm with this row. The id must be in the table.
Alarm raise(std::string_view id, Alarm::Parameters parameters);
// Makes alarms from sentences alone, without ids.
std::vector<Alarm> alarms_of(const std::vector<std::string>& sentences);

// Writes alarms into a status: station_status_t or fusion_status_t.
template <class Status>
void set_alarms(const std::vector<Alarm>& alarms, Status& status) {
  for (const Alarm& alarm : alarms) {
    for (const auto& [name, value] : alarm.parameters) {
      status.alarm_parameter_of.push_back(static_cast<std::int16_t>(status.alarm_id.size()));
      status.alarm_parameter_name.push_back(name);
      status.alarm_parameter_value.push_back(value);
    }
    status.alarm.push_back(alarm.text);
    status.alarm_id.push_back(alarm.id);
  }
  status.alarms = status.alarm_ids = static_cast<std::int16_t>(status.alarm.size());
  status.alarm_parameters = static_cast<std::int16_t>(status.alarm_parameter_of.size());
}

template <class Status>
std::vector<Alarm> alarms_of(const Status& status, std::size_t most = -1) {
  std::vector<Alarm> alarms;
  const bool has_ids = status.alarm_id.size() == status.alarm.size();
  for (std::size_t i = 0; i < std::min(status.alarm.size(), most); ++i) {
    alarms.push_back({status.alarm[i], has_ids ? status.alarm_id[i] : "", {}});
  }
  for (std::size_t i = 0; i < status.alarm_parameter_of.size(); ++i) {
    const auto whose = static_cast<std::size_t>(status.alarm_parameter_of[i]);
    if (whose >= alarms.size()) continue;
    alarms[whose].parameters.emplace_back(status.alarm_parameter_name[i],
                                          status.alarm_parameter_value[i]);
  }
  return alarms;
}

}  // namespace ols
