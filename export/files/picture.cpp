#include "export/files/picture.h"

#include <algorithm>
#include <cmath>

#include "export/present_targets.h"
#include "geometry/angles.h"
#include "geometry/wgs84.h"

namespace ols::exports {
namespace {

// A target has ended by then; a station reports at 0.01 Hz at least.
constexpr auto kLive_us = static_cast<std::int64_t>(1e6 * (PresentTargets::kSilent_s + 2.0));
constexpr std::int64_t kStationGone_us = 300'000'000;
constexpr std::int64_t kEver_us = std::numeric_limits<std::int64_t>::max();

template <class Record>
void add(std::deque<Record>& points, const Record& record, std::int64_t spacing_us) {
  // The newest point is always there; the one before it only if it is far enough from its
  // predecessor.
  const std::size_t count = points.size();
  if (count >= 2 && points[count - 1].utime_us - points[count - 2].utime_us < spacing_us) {
    points.pop_back();
  }
  points.push_back(record);
}

// All but the newest.
template <class Record>
void remove_before(std::deque<Record>& points, std::int64_t utime_us) {
  while (points.size() > 1 && points.front().utime_us < utime_us) points.pop_front();
}

}  // namespace

std::int64_t Picture::history_us() const {
  return std::isfinite(limits_.history_s) ? static_cast<std::int64_t>(1e6 * limits_.history_s)
                                          : kEver_us;
}

std::int64_t Picture::spacing_us() const {
  if (history_us() == kEver_us) return 0;
  const auto sharers = static_cast<std::int64_t>(tracks_.size() + lines_.size());
  return history_us() / std::max<std::int64_t>(limits_.most_points / sharers, 1);
}

bool Picture::fits(const Place& place) const {
  return !limits_.needs_sea || std::isfinite(place.geoid_m);
}

void Picture::take(const Station& station) {
  if (fits(station.place)) stations_[station.uid] = station;
}

void Picture::take(const Target& target) {
  // An end has no place of its own; it ends what is there.
  if (target.state == TrackState::kEnded ? !tracks_.contains(target.uid) : !fits(target.place))
    return;
  Track& track = tracks_[target.uid];
  const bool is_end = target.state == TrackState::kEnded;
  track.last = target;
  if (!is_end) add(track.points, target, spacing_us());
}

void Picture::take(const Line& line) {
  if (!fits(line.camera)) return;
  std::deque<Line>& points = lines_[line.uid].points;
  add(points, line, spacing_us());
}

void Picture::forget(std::int64_t utime_us) {
  if (history_us() == kEver_us) return;
  const std::int64_t limit_us = utime_us - history_us();
  const std::int64_t gone_us = std::min(limit_us, utime_us - kLive_us);
  for (auto& [uid, track] : tracks_) remove_before(track.points, limit_us);
  for (auto& [uid, seen] : lines_) remove_before(seen.points, limit_us);
  std::erase_if(tracks_, [&](const auto& entry) {
    const Target& last = entry.second.last;
    return last.utime_us < (last.state == TrackState::kEnded ? limit_us : gone_us);
  });
  std::erase_if(lines_,
                [&](const auto& entry) { return entry.second.points.back().utime_us < gone_us; });
  std::erase_if(stations_, [&](const auto& entry) {
    return entry.second.utime_us < utime_us - kStationGone_us;
  });
}

Place end_of(const Line& line, double distance_m) {
  const double azimuth = radians(line.azimuth_deg), elevation = radians(line.elevation_deg);
  const LocalFrame frame({radians(line.camera.latitude_deg), radians(line.camera.longitude_deg),
                          line.camera.height_m});
  const Geodetic there = geodetic_from_ecef(frame.to_ecef(
      distance_m * Eigen::Vector3d(std::cos(elevation) * std::sin(azimuth),
                                   std::cos(elevation) * std::cos(azimuth), std::sin(elevation))));
  return {degrees(there.latitude_rad), degrees(there.longitude_rad), there.height_m,
          line.camera.geoid_m};
}

}  // namespace ols::exports
