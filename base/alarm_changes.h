// Finds which of a program's alarms begin and which end. Pure.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace ols {

// The identity of an alarm, whatever its numbers: "ptu: silent for 5 s" and "... for 6 s" have one
// key.
std::string alarm_key(const std::string& alarm);

class AlarmChanges {
 public:
  struct Change {
    std::string key;  // the same at the beginning and at the end
    std::string alarm;
    bool begins = false;
  };
  // Takes the current alarms. A changed number ("silent for 5 s") does not make an alarm new.
  std::vector<Change> look(const std::vector<std::string>& alarms);

 private:
  std::map<std::string, std::string> alarms_;  // by key
};

}  // namespace ols
