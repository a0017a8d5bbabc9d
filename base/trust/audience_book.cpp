#include "base/trust/audience_book.h"

namespace ols::trust {

void AudienceBook::hear(std::string_view station, std::int64_t boot_id, bool fresh, double now_s) {
  auto heard = stations_.find(station);
  if (heard == stations_.end()) heard = stations_.try_emplace(std::string(station)).first;
  if (!fresh && now_s - heard->second.fresh_s < kPreferred_s) return;
  heard->second.boot_id = boot_id;
  if (fresh) heard->second.fresh_s = now_s;
}

std::int64_t AudienceBook::boot_of(std::string_view station) const {
  const auto heard = stations_.find(station);
  return heard == stations_.end() ? 0 : heard->second.boot_id;
}

}  // namespace ols::trust
