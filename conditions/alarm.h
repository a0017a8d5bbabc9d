// Which alarm of conditions.toml a sentence is. Pure.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ols {

// The table as the build has it: sentences with more words first.
struct AlarmSentence {
  std::string_view id;
  std::string_view english;   // "ptu: supply voltage low ({volts} V)"
  std::string_view subject;   // " station axis ": the parameters that belong to the key
  std::string_view severity;  // "urgent", "warning", "notice"
  std::string_view action;    // what to do
};
std::span<const AlarmSentence> alarm_sentences();

struct Alarm {
  std::string text;
  std::string id;  // of the table; empty: it has no such sentence
  std::vector<std::pair<std::string, std::string>> parameters;  // name, value; as in the sentence

  // The same while an alarm holds: its id and subject ("station_silent s1"), whatever its other
  // parameters. An alarm that the table does not have is its own key.
  std::string key() const;
  // Its sentence with its subject, and "…" for whatever else changes while it holds.
  std::string gist() const;
  // A warning without words where the table does not have it.
  const AlarmSentence& row() const;

 private:
  bool is_subject(const std::string& parameter) const {
    return row().subject.find(" " + parameter + " ") != std::string_view::npos;
  }
};
// What a sentence says behind the first of these words: "no reply", of "ptu: no reply" and ": ".
std::string said_behind(std::string_view words, std::string_view sentence);

// Found by its words: where it is raised, and in logs of before messages said what it is.
Alarm alarm_of(std::string_view sentence);
std::vector<Alarm> alarms_of(const std::vector<std::string>& sentences);

// The alarms of a status: station_status_t or fusion_status_t.
template <class Status>
void set_alarms(std::vector<std::string> sentences, Status& status) {
  for (const std::string& sentence : sentences) {
    const Alarm alarm = alarm_of(sentence);
    for (const auto& [name, value] : alarm.parameters) {
      status.alarm_parameter_of.push_back(static_cast<std::int16_t>(status.alarm_id.size()));
      status.alarm_parameter_name.push_back(name);
      status.alarm_parameter_value.push_back(value);
    }
    status.alarm_id.push_back(alarm.id);
  }
  status.alarm = std::move(sentences);
  status.alarms = status.alarm_ids = static_cast<std::int16_t>(status.alarm.size());
  status.alarm_parameters = static_cast<std::int16_t>(status.alarm_parameter_of.size());
}

template <class Status>
std::vector<Alarm> alarms_of(const Status& status, std::size_t most = -1) {
  std::vector<Alarm> alarms;
  const bool says_ids = status.alarm_id.size() == status.alarm.size();
  for (std::size_t i = 0; i < std::min(status.alarm.size(), most); ++i) {
    alarms.push_back(says_ids ? Alarm{status.alarm[i], status.alarm_id[i], {}}
                              : alarm_of(status.alarm[i]));
  }
  if (!says_ids) return alarms;
  for (std::size_t i = 0; i < status.alarm_parameter_of.size(); ++i) {
    const auto whose = static_cast<std::size_t>(status.alarm_parameter_of[i]);
    if (whose >= alarms.size()) continue;
    alarms[whose].parameters.emplace_back(status.alarm_parameter_name[i],
                                          status.alarm_parameter_value[i]);
  }
  return alarms;
}

}  // namespace ols
