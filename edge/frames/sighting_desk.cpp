#include "edge/frames/sighting_desk.h"

namespace ols::station {

std::vector<Sighting> SightingDesk::take(const Bearing& bearing, std::int64_t utime_us,
                                         const PointingModel& unit) {
  // Farther apart they do not tell what was between them.
  constexpr std::int64_t kSecond_us = 1'000'000, kApart_us = 250'000;
  const auto counts = unit.counts_at(bearing.mid_exposure_s);
  const std::optional<Sighting> before = last_;
  last_.reset();
  if (!counts) return {};
  last_ = Sighting{bearing, utime_us, *counts};
  if (!before || before->bearing.track_id != bearing.track_id) return {};
  if (utime_us <= before->utime_us || utime_us - before->utime_us > kApart_us) return {};
  if (before->utime_us / kSecond_us == utime_us / kSecond_us) return {};
  return {*before, *last_};
}

}  // namespace ols::station
