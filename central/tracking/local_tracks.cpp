#include "central/tracking/local_tracks.h"

#include <algorithm>

namespace ols::fusion {

const LocalTracks::Object* LocalTracks::find(const BearingMeasurement& measurement) const {
  const auto station = stations_.find(measurement.station);
  if (station == stations_.end()) return nullptr;
  const auto own = station->second.find(measurement.track_id);
  return own == station->second.end() ? nullptr : &own->second;
}

LocalTracks::Object& LocalTracks::at(const BearingMeasurement& measurement) {
  auto& objects = stations_[measurement.station];
  if (objects.size() >= kOfAStation && !objects.contains(measurement.track_id)) {
    objects.erase(std::ranges::min_element(
        objects, {}, [](const auto& entry) { return entry.second.newest_us; }));
  }
  const auto [own, is_new] = objects.try_emplace(measurement.track_id);
  if (is_new) own->second.since_us = measurement.utime_us;
  own->second.newest_us = std::max(own->second.newest_us, measurement.utime_us);
  return own->second;
}

void LocalTracks::rename(std::int64_t from, std::int64_t to) {
  for (auto& [station, objects] : stations_) {
    for (auto& [name, object] : objects) {
      if (object.id == from) object.id = to;
    }
  }
}

std::size_t LocalTracks::size(const std::string& station) const {
  const auto found = stations_.find(station);
  return found == stations_.end() ? 0 : found->second.size();
}

}  // namespace ols::fusion
