// Raises an alarm if commands are repeatedly refused before they reach the station. A legitimate
// sender may be locked out, and its operator should learn why. Pure.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "conditions/alarm.h"

namespace ols::station {

class RefusalMonitor {
 public:
  // Notes that a command of this kind ("slews") was refused. There must be few different kinds and
  // reasons, because a counter is kept for each pair.
  void note(const std::string& kind, const std::string& why, double now_s);
  // One alarm for each kind and reason with three or more refusals within kSpan_s: "commands: 12
  // slews refused in 10 s: this command was taken before".
  std::vector<Alarm> alarms(double now_s) const;

 private:
  static constexpr std::size_t kSpan_s = 10;
  struct Second {
    std::int64_t at_s = -1;
    std::uint64_t count = 0;
  };

  std::map<std::pair<std::string, std::string>, std::array<Second, kSpan_s>> refused_;
};

}  // namespace ols::station
