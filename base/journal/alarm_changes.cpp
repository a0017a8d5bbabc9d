#include "base/journal/alarm_changes.h"

#include <utility>

namespace ols {

std::vector<AlarmChanges::Change> AlarmChanges::look(const std::vector<Alarm>& alarms) {
  std::vector<Change> changes;
  std::map<std::string, Alarm> now;
  for (const Alarm& alarm : alarms) {
    const std::string key = alarm.key();
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
