#include "base/alarm_changes.h"

#include <cctype>
#include <utility>

namespace ols {

// Without its digits, but for the words before the first colon: "station s2" is not "station s1".
// Behind a semicolon stands what is said besides, such as the newest of many causes.
std::string alarm_key(const std::string& alarm) {
  const std::size_t colon = alarm.find(": ");
  const std::size_t begin = colon == std::string::npos ? 0 : colon;
  std::string text = alarm.substr(begin, alarm.find(';', begin) - begin);
  std::erase_if(text, [](unsigned char c) { return std::isdigit(c) != 0; });
  return alarm.substr(0, begin) + text;
}

std::vector<AlarmChanges::Change> AlarmChanges::look(const std::vector<std::string>& alarms) {
  std::vector<Change> changes;
  std::map<std::string, std::string> now;
  for (const std::string& alarm : alarms) {
    const std::string key = alarm_key(alarm);
    if (!alarms_.contains(key) && !now.contains(key)) changes.push_back({key, alarm, true});
    now[key] = alarm;
  }
  for (const auto& [key, alarm] : alarms_) {
    if (!now.contains(key)) changes.push_back({key, alarm, false});
  }
  alarms_ = std::move(now);
  return changes;
}

}  // namespace ols
