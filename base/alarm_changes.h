// Which of a program's alarms begin and which end. Pure.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace ols {

// Which alarm a text is, whatever its numbers: "ptu: silent for 5 s" and "... for 6 s" are one.
std::string alarm_key(const std::string& alarm);

class AlarmChanges {
 public:
  struct Change {
    std::string key;  // the same when it begins and when it ends
    std::string alarm;
    bool begins = false;
  };
  // The alarms that hold now. A changed number ("silent for 5 s") does not make one a new alarm.
  std::vector<Change> look(const std::vector<std::string>& alarms);

 private:
  std::map<std::string, std::string> alarms_;  // by their keys
};

}  // namespace ols
