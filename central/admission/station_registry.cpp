#include "central/admission/station_registry.h"

#include <algorithm>
#include <tuple>

namespace ols::fusion {
namespace {

constexpr double kForgottenS = 10.0;  // silent for longer: any other station may replace it

// Foreign stations must not displace one that keeps delivering.
bool is_evictable(const std::string& name, const KnownStation& station, const MessageTime& time) {
  constexpr std::int64_t kAtHome = 10;  // fewer bearings: any other station may replace it
  return station.bearings < kAtHome || time.silent_s(name) > kForgottenS;
}

}  // namespace

bool StationRegistry::belongs(const std::string& station) const {
  return names_.empty() || std::ranges::find(names_, station) != names_.end();
}

bool StationRegistry::full(const std::string& station) const {
  return stations_.size() >= static_cast<std::size_t>(most_) && !stations_.contains(station);
}

// Silence is counted in messages, not by stamps, because a station's clock may be wrong. Stations
// without a bearing come first.
StationRegistry::Entry StationRegistry::longest_silent(const MessageTime& time) {
  return std::ranges::min_element(stations_, {}, [&](const auto& entry) {
    const KnownStation& station = entry.second;
    return std::tuple(station.delivered, !is_evictable(entry.first, station, time), station.heard);
  });
}

StationRegistry::Place StationRegistry::take(const std::string& station,
                                             std::optional<Entry> evicted) {
  Place place;
  if (evicted) {
    place.evicted = (*evicted)->first;
    stations_.erase(*evicted);
  }
  place.station = &stations_[station];
  return place;
}

StationRegistry::Place StationRegistry::for_bearing(const std::string& station,
                                                    const MessageTime& time) {
  std::optional<Entry> evicted;
  if (full(station)) {
    evicted = longest_silent(time);
    if (!is_evictable((*evicted)->first, (*evicted)->second, time)) return {};
  }
  Place place = take(station, evicted);
  place.station->delivered = true;
  place.station->heard = ++messages_;
  return place;
}

StationRegistry::Place StationRegistry::for_status(const std::string& station,
                                                   const MessageTime& time) {
  std::optional<Entry> evicted;
  if (full(station)) {
    evicted = longest_silent(time);
    const bool delivers =
        (*evicted)->second.delivered && time.silent_s((*evicted)->first) < kForgottenS;
    if (delivers) return {};
  }
  Place place = take(station, evicted);
  if (!place.station->delivered) place.station->heard = ++messages_;
  return place;
}

}  // namespace ols::fusion
