// Which alarm of conditions.toml a sentence is. Statuses carry sentences, and logs of before carry
// nothing else; so what tells alarms apart is found in the sentence, by the table that it was made
// from. Pure.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ols {

struct Alarm {
  std::string id;  // of the table; empty: it has no such sentence
  std::vector<std::pair<std::string, std::string>> parameters;  // name, value; as in the sentence
};
Alarm alarm_of(std::string_view sentence);

// The same while an alarm holds: its id and subject ("station s1"), whatever its other parameters.
// A sentence that the table does not have is its own key.
std::string alarm_key(const std::string& sentence);

// The table as the build has it: those with more words first.
struct AlarmSentence {
  std::string_view id;
  std::string_view english;  // "ptu: supply voltage low ({volts} V)"
  std::string_view subject;  // " station axis ": the parameters that belong to the key
};
std::span<const AlarmSentence> alarm_sentences();

}  // namespace ols
