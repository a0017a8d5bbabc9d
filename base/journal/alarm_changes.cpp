#include "base/journal/alarm_changes.h"

#include <utility>

#include "conditions/alarm.h"

namespace ols {

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
