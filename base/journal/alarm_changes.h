// Finds which of a program's alarms begin and which end. Pure.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace ols {

class AlarmChanges {
 public:
  struct Change {
    std::string key;  // the same at the beginning and at the end
    std::string alarm;
    bool begins = false;
  };
  // Takes the current alarms. alarm_key() tells which are the same: "silent for 5 s", "for 6 s".
  std::vector<Change> look(const std::vector<std::string>& alarms);

 private:
  std::map<std::string, std::string> alarms_;  // by key
};

}  // namespace ols
