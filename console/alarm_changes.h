// Which alarms have begun and ended between two lists of them. Pure.
#pragma once

#include <string>
#include <vector>

namespace ols::console {

struct AlarmChanges {
  std::vector<std::string> begun, ended;
};

// An alarm whose numbers alone have changed ("no frames for 3 s", "... 4 s") is the same one.
AlarmChanges alarm_changes(const std::vector<std::string>& before,
                           const std::vector<std::string>& now);

}  // namespace ols::console
