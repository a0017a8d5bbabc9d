#include "base/trust/station_boots.h"

namespace ols::trust {

void StationBoots::hear(std::string_view station, std::int64_t boot_id, bool fresh, double now_s) {
  if (!fresh && !may_be_own(station, boot_id, now_s)) return;
  auto heard = stations_.find(station);
  if (heard == stations_.end()) heard = stations_.try_emplace(std::string(station)).first;
  heard->second.boot_id = boot_id;
  if (!fresh) return;
  heard->second.fresh_s = now_s;
  heard->second.fresh_boot_id = boot_id;
}

bool StationBoots::may_be_own(std::string_view station, std::int64_t boot_id, double now_s) const {
  const auto heard = stations_.find(station);
  if (heard == stations_.end()) return true;
  const bool same = boot_id == heard->second.fresh_boot_id;
  return now_s - heard->second.fresh_s >= (same ? kPreferred_s : kReboot_s);
}

std::int64_t StationBoots::boot_of(std::string_view station) const {
  const auto heard = stations_.find(station);
  return heard == stations_.end() ? 0 : heard->second.boot_id;
}

}  // namespace ols::trust
