// Finds which of a program's alarms begin and which end. Pure.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "conditions/alarm.h"

namespace ols {

class AlarmChanges {
 public:
  struct Change {
    std::string key;  // the same at the beginning and at the end
    Alarm alarm;
    bool begins = false;
  };
  // Takes the current alarms; returns what has changed since the last call. Alarms with equal keys
  // are the same alarm: "silent for 5 s" and "silent for 6 s".
  std::vector<Change> look(const std::vector<Alarm>& alarms);

 private:
  std::map<std::string, Alarm> alarms_;  // by key
};

}  // namespace ols
