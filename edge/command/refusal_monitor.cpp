#include "edge/command/refusal_monitor.h"

#include <cmath>

#include "conditions/alarms.h"

namespace ols::station {
namespace {

constexpr std::uint64_t kAlarm = 3;  // a duplicated datagram or two raise no alarm

}  // namespace

void RefusalMonitor::note(const std::string& kind, const std::string& why, double now_s) {
  const auto second_s = static_cast<std::int64_t>(std::floor(now_s));
  Second& second = refused_[{kind, why}][static_cast<std::size_t>(second_s) % kSpan_s];
  if (second.at_s != second_s) second = {second_s, 0};
  ++second.count;
}

std::vector<Alarm> RefusalMonitor::alarms(double now_s) const {
  const auto second_s = static_cast<std::int64_t>(std::floor(now_s));
  std::vector<Alarm> alarms;
  for (const auto& [what, seconds] : refused_) {
    std::uint64_t count = 0;
    for (const Second& second : seconds) {
      if (second.at_s > second_s - static_cast<std::int64_t>(kSpan_s)) count += second.count;
    }
    if (count < kAlarm) continue;
    alarms.push_back(alarm::commands_refused(count, what.first, kSpan_s, what.second));
  }
  return alarms;
}

}  // namespace ols::station
