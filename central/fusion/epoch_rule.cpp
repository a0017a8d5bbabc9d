#include "central/fusion/epoch_rule.h"

#include <algorithm>

#include "central/fusion/output_period.h"
#include "central/measurement/activity.h"
#include "central/measurement/time_span.h"

namespace ols::fusion {
namespace {

// Greatest differences between two frames of one instant: of their arrivals, and of their stamps.
constexpr std::int64_t kArrivalUs = 20'000, kStampUs = 5'000;

}  // namespace

void EpochRule::hear(const std::string& station, std::int64_t utime_us, std::int64_t now_us) {
  ++changes_;
  Station& own = stations_[station];
  if (utime_us > own.newest_us) {
    const std::int64_t interval_us = own.newest_us == 0 ? 0 : utime_us - own.newest_us;
    own.interval_us =
        own.last_interval_us == 0 ? interval_us : std::min(interval_us, own.last_interval_us);
    own.last_interval_us = interval_us;
    own.newest_us = utime_us;
  }
  if (utime_us <= now_us + own.interval_us) newest_us_ = std::max(newest_us_, utime_us);
}

bool EpochRule::Station::is_due(std::int64_t by_us) const {
  const std::int64_t ahead_us = newest_us + interval_us - by_us;
  return ahead_us <= std::min(kStampUs, interval_us / 4) && ahead_us >= -kArrivalUs;
}

bool EpochRule::most_have_arrived() const {
  std::size_t delivering = 0, due = 0;
  for (const auto& [name, station] : stations_) {
    if (seconds(newest_us_ - station.newest_us) > Activity::kDeliversS) continue;
    ++delivering;
    due += station.interval_us > 0 && station.is_due(newest_us_) ? 1 : 0;
  }
  return 2 * due < delivering;
}

std::optional<std::int64_t> EpochRule::after(const std::optional<std::int64_t>& last_us,
                                             double rate_hz) {
  constexpr std::size_t kMany = 32;
  if (newest_us_ == 0 || !is_due(last_us, newest_us_, rate_hz)) return std::nullopt;
  if (is_due(last_us, newest_us_ - kArrivalUs, rate_hz)) return newest_us_;
  if (changes_ <= stations_.size() / kMany) return std::nullopt;
  changes_ = 0;
  return most_have_arrived() ? std::optional(newest_us_) : std::nullopt;
}

}  // namespace ols::fusion
