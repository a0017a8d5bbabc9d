#include "central/admission/shared_mount.h"

#include <cstdlib>

#include "conditions/alarms.h"

namespace ols::fusion {
namespace {

// Older statements may be of a station that has ended, or has got another name.
constexpr std::int64_t kTogether_us = 10'000'000;

}  // namespace

std::vector<Alarm> shared_mount_alarms(const std::map<std::string, KnownStation>& stations) {
  std::vector<Alarm> alarms;
  std::map<std::string, const std::pair<const std::string, KnownStation>*> owners;
  for (const auto& entry : stations) {
    const StationTraits& traits = entry.second.traits;
    if (traits.mount.empty()) continue;
    const auto [owner, is_first] = owners.emplace(traits.mount, &entry);
    if (is_first) continue;
    const std::int64_t apart_us = traits.stated_us - owner->second->second.traits.stated_us;
    if (std::abs(apart_us) < kTogether_us) {
      alarms.push_back(
          alarm::stations_share_mount(owner->second->first, entry.first, traits.mount));
    } else if (apart_us > 0) {
      owner->second = &entry;
    }
  }
  return alarms;
}

}  // namespace ols::fusion
