#include "export/present_targets.h"

#include <algorithm>
#include <utility>

namespace ols::exports {

Target PresentTargets::ended(Target target, std::int64_t utime_us) {
  target.state = TrackState::kEnded;
  target.utime_us = std::max(utime_us, target.utime_us);
  target.velocity_enu_m_s.fill(kUnknown);
  return target;
}

std::vector<Target> PresentTargets::take(const Target& target) {
  const auto known = live_.find(target.uid);
  if (target.state == TrackState::kEnded) {
    if (known == live_.end()) return {};
    const Target last = ended(std::move(known->second), target.utime_us);
    live_.erase(known);
    return {last};
  }
  if (known != live_.end() && target.utime_us < known->second.utime_us) return {};
  live_[target.uid] = target;
  if (live_.size() <= kMost) return {target};
  const auto oldest =
      std::ranges::min_element(live_, {}, [](const auto& entry) { return entry.second.utime_us; });
  const Target end = ended(std::move(oldest->second), target.utime_us);
  live_.erase(oldest);
  return {end, target};
}

std::vector<Target> PresentTargets::end_silent(std::int64_t utime_us) {
  const auto limit_us = utime_us - static_cast<std::int64_t>(kSilent_s * 1e6);
  std::vector<Target> ends;
  for (auto entry = live_.begin(); entry != live_.end();) {
    if (entry->second.utime_us >= limit_us) {
      ++entry;
      continue;
    }
    ends.push_back(ended(std::move(entry->second), utime_us));
    entry = live_.erase(entry);
  }
  return ends;
}

}  // namespace ols::exports
