#include "central/tracking/track_manager.h"

#include <algorithm>

#include "central/measurement/time_span.h"
#include "central/tracking/behind_land.h"
#include "central/tracking/likeness.h"
#include "central/tracking/position_guard.h"
#include "central/tracking/target_appearance.h"

namespace ols::fusion {

TrackManager::TrackManager(const TrackManagerConfig& config, const FilterConfig& filter,
                           bool same_place)
    : config_(config),
      initiation_(config.initiation, filter),
      errors_(config.errors),
      identities_(same_place) {}

Track& TrackManager::begin(Track track) {
  ++counts_.initiated;
  tracks_.push_back(std::move(track));
  glances_.push_back(summarise_track(tracks_.back()));
  return tracks_.back();
}

void TrackManager::replace(Track& track, Track by) {
  by.id = track.id;
  by.state = track.state;
  track = std::move(by);
  glances_[static_cast<std::size_t>(&track - tracks_.data())] = summarise_track(track);
}

Association TrackManager::give_to(Track& track, const BearingMeasurement& measurement,
                                  const Innovation* seen) {
  const FilterUpdate update = track.filter.update(measurement, errors_, seen);
  errors_.learn(update.evidence);
  glances_[static_cast<std::size_t>(&track - tracks_.data())] = summarise_track(track);
  if (update.use != BearingUse::kUsed) {
    ++track.misses;
    ++counts_.rejected;
    return {Association::Kind::kRejected, track.id};
  }
  ++track.hits[measurement.station];
  keep(track, measurement);
  identities_.follow(measurement, track);
  if (stations_lately(track.filter, Activity::kDeliversS) >= 2) {
    track.last_two_station_us = track.filter.utime_us();
    if (track.state == TrackState::kCoasting) track.state = TrackState::kConfirmed;
  }
  const std::int64_t id = track.id;
  if (track.state == TrackState::kTentative) consider(track);
  return {Association::Kind::kTrack, id};
}

void TrackManager::keep(Track& track, const BearingMeasurement& measurement) const {
  auto& own = track.bearings[measurement.station];
  const auto place =
      std::ranges::upper_bound(own, measurement.utime_us, {}, &BearingMeasurement::utime_us);
  own.insert(place, measurement);
  track.last.note(measurement);
  const auto span_us = static_cast<std::int64_t>(config_.memory_s * 1e6);
  const std::int64_t oldest_us = own.back().utime_us - span_us;
  const auto kept = std::ranges::lower_bound(own, oldest_us, {}, &BearingMeasurement::utime_us);
  constexpr std::ptrdiff_t kTogether = 16;  // in a batch: removing each alone would move all others
  if (kept - own.begin() >= kTogether) own.erase(own.begin(), kept);
}

bool TrackManager::is_duplicate(const Track& track) const {
  return std::ranges::any_of(tracks_, [&](const Track& other) {
    return &other != &track && is_established(other) && are_duplicates(track.filter, other.filter);
  });
}

void TrackManager::consider(Track& track) {
  const KinematicState now = track.filter.at(track.filter.utime_us());
  if (judge_position(track.filter, now) != Solution::kOk || !is_worth_confirming(track)) return;
  if (is_duplicate(track)) {
    track.state = TrackState::kDeleted;
    return;
  }
  confirm(track);
}

void TrackManager::confirm(Track& track) {
  track.state = TrackState::kConfirmed;
  ++counts_.confirmed;
  if (track.id == 0) identities_.confirm(track, tracks_);
  for (const auto& [station, bearings] : track.bearings) {
    if (!bearings.empty()) identities_.follow(bearings.back(), track);
  }
  on_confirmed(track);
}

// What was learnt of a station remains if another track has the station, too.
void TrackManager::forget_what_it_taught(const Track& track) {
  const auto has_another = [&](const std::string& station) {
    return std::ranges::any_of(tracks_, [&](const Track& other) {
      return &other != &track && is_established(other) && other.bearings.contains(station) &&
             !is_inconsistent_pair(other.filter);
    });
  };
  for (const FilterStation& station : track.filter.stations()) {
    if (!has_another(station.station)) errors_.forget(station.station);
  }
}

void TrackManager::age(Track& track, std::int64_t now_us) {
  if (is_inconsistent_pair(track.filter) ||
      is_behind_land(
          track.filter,
          config_.initiation.land.get())) {  // what it has taught of the stations is wrong, too
    forget_what_it_taught(track);
    track.state = TrackState::kDeleted;
    return;
  }
  const double unseen_s = seconds(now_us - track.last_two_station_us);
  if (track.state == TrackState::kTentative) {
    if (is_tentative_lost(unseen_s)) track.state = TrackState::kDeleted;
  } else if (unseen_s > config_.coast_s || unseen_s > config_.drop_s) {
    if (unseen_s > config_.coast_s) track.state = TrackState::kCoasting;
    if (is_lost(track, unseen_s, now_us)) track.state = TrackState::kDeleted;
  }
}

void TrackManager::advance(std::int64_t now_us) {
  for (Track& track : tracks_) {
    if (track.state == TrackState::kDeleted) continue;
    age(track, now_us);
    if (is_established(track)) look_at_class(track, config_.initiation.land.get());
  }
  merge_duplicates();
  for (const Track& track : tracks_) {
    if (track.state != TrackState::kDeleted) continue;
    ++counts_.deleted;
    if (track.id != 0) identities_.keep_deleted(track);
  }
  std::erase_if(tracks_, [](const Track& t) { return t.state == TrackState::kDeleted; });
  glances_.clear();
  for (const Track& track : tracks_) glances_.push_back(summarise_track(track));
  identities_.forget_deleted(now_us, config_.remember_s + config_.drop_s);
}

std::optional<Eigen::Vector2d> TrackManager::off_nearest(
    const BearingMeasurement& measurement) const {
  const RayFrame frame = ray_frame(measurement.sight);
  std::optional<Eigen::Vector2d> best;
  for (const Track& track : tracks_) {
    if (track.state != TrackState::kConfirmed) continue;
    const KinematicState& state = track.filter.summary();
    const double dt_s = seconds(measurement.utime_us - state.utime_us);
    const Eigen::Vector3d line =
        state.mean.head<3>() + dt_s * state.mean.segment<3>(3) - measurement.sight.origin_ecef;
    const double depth = frame.direction.dot(line);
    if (!(depth > 0.0)) continue;
    const Eigen::Vector2d off = frame.tangent.transpose() * line / depth;
    if (!best || off.norm() < best->norm()) best = off;
  }
  return best;
}

std::int64_t TrackManager::identify(const BearingMeasurement& newest,
                                    std::set<std::int64_t>& told) {
  return identities_.identify(newest, config_.confirm_s, told, tracks_);
}

bool TrackManager::takes(const BearingMeasurement& newest, std::int64_t now_us,
                         double within_s) const {
  return identities_.takes(newest, now_us, within_s, tracks_);
}

void TrackManager::forget_station(const std::string& station) {
  errors_.forget(station);
  initiation_.forget(station);
  identities_.forget(station);
}

void TrackManager::clear_tracks() {
  initiation_.clear();
  errors_.clear();
  tracks_.clear();
  glances_.clear();
  identities_.clear();
  counts_ = {};
}

}  // namespace ols::fusion
