#include "central/tracking/duplicate_tracks.h"

#include <algorithm>
#include <cmath>

#include "central/measurement/time_span.h"

namespace ols::fusion {
namespace {

constexpr std::size_t kMostTracks = 4;  // max number per bearing
constexpr std::size_t kMostPairs = 64;

}  // namespace

void DuplicateTracks::note(const BearingMeasurement& measurement,
                           std::span<const std::int64_t> tracks) {
  if (tracks.empty()) return;
  const auto explains = [&](std::int64_t id) {
    return std::ranges::find(tracks, id) != tracks.end();
  };
  const auto best = tracks.first(std::min(tracks.size(), kMostTracks));
  for (std::size_t i = 0; i < best.size() && pairs_.size() < kMostPairs; ++i) {
    for (std::size_t k = i + 1; k < best.size(); ++k) {
      const auto [own, is_new] = pairs_.try_emplace(std::minmax(best[i], best[k]));
      if (is_new) own->second.since_us = own->second.newest_us = measurement.utime_us;
    }
  }
  for (auto& [ids, pair] : pairs_) {
    if (ids.first != best.front() && ids.second != best.front()) continue;
    count(pair, measurement, explains(ids.first) && explains(ids.second),
          ids.first == best.front());
  }
  std::erase_if(pairs_, [&](const auto& entry) {
    return seconds(measurement.utime_us - entry.second.newest_us) > 3.0 * config_.memory_s;
  });
}

void DuplicateTracks::count(Pair& pair, const BearingMeasurement& measurement, bool shared,
                            bool first) const {
  Tally& own = pair.stations[measurement.station];
  if (shared) pair.newest_us = std::max(pair.newest_us, measurement.utime_us);
  if (is_one_exposure(own.utime_us, measurement.utime_us)) {
    ++own.bearings;
    own.shared = own.shared || shared;
    return;
  }
  const double decay =
      std::exp(-std::abs(seconds(measurement.utime_us - own.utime_us)) / config_.memory_s);
  const bool single = own.bearings == 1;
  own.single = decay * (own.single + (single ? 1.0 : 0.0));
  own.both_explain = decay * (own.both_explain + (single && own.shared ? 1.0 : 0.0));
  own.first_best = decay * (own.first_best + (single && own.first ? 1.0 : 0.0));
  own.apart = decay * (own.apart + (own.bearings > 1 ? 1.0 : 0.0));
  own.utime_us = measurement.utime_us;
  own.bearings = 1;
  own.shared = shared;
  own.first = first;
}

bool DuplicateTracks::are_same(const Pair& pair) const {
  if (seconds(pair.newest_us - pair.since_us) < config_.long_s) return false;
  constexpr double kLeast = 3.0;  // exposures; with fewer a station is not judged
  double single = 0.0, apart = 0.0;
  int judged = 0, agree = 0;
  for (const auto& [station, own] : pair.stations) {
    const double past_s = std::max(0.0, seconds(pair.newest_us - own.utime_us));
    const double decay = std::exp(-past_s / config_.memory_s);
    single += decay * own.single;
    apart += decay * own.apart;
    if (decay * own.single < kLeast) continue;
    if (own.both_explain < config_.both_explain * own.single) return false;
    ++judged;
    const double second_best = own.single - own.first_best;
    agree += std::min(own.first_best, second_best) >= config_.each_best * own.single ? 1 : 0;
  }
  return agree >= 2 && 2 * agree > judged && single >= config_.least_single &&
         apart <= config_.most_apart * single;
}

std::vector<std::pair<std::int64_t, std::int64_t>> DuplicateTracks::same() const {
  std::vector<std::pair<std::int64_t, std::int64_t>> found;
  for (const auto& [ids, pair] : pairs_) {
    if (are_same(pair)) found.push_back(ids);
  }
  return found;
}

void DuplicateTracks::forget(std::int64_t track) {
  std::erase_if(pairs_, [&](const auto& entry) {
    return entry.first.first == track || entry.first.second == track;
  });
}

}  // namespace ols::fusion
