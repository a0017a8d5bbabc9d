#include "central/tracking/track_keeper.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "central/measurement/time_span.h"

namespace ols {
namespace {

// In a recording of one object two stations see the same one, however far they have to be turned.
FilterConfig filter_config(const KeeperConfig& config) {
  FilterConfig filter = config.filter;
  if (config.one_target) filter.two_stations_nis = std::numeric_limits<double>::infinity();
  return filter;
}

}  // namespace

TrackKeeper::Glance TrackKeeper::glance_at(const Track& track) {
  const KinematicState& state = track.filter.summary();
  return {state.utime_us, state.mean.head<3>(), state.mean.segment<3>(3),
          std::sqrt(state.covariance.topLeftCorner<3, 3>().trace()),
          std::sqrt(state.covariance.block<3, 3>(3, 3).trace())};
}

// Within so many of everything that may be off.
bool TrackKeeper::Glance::may_see(const Sighting& sighting, const Eigen::Vector3d& d) const {
  const double dt_s = seconds(sighting.utime_us - utime_us);
  const Eigen::Vector3d line = p_ecef + dt_s * v_ecef - sighting.sight.origin_ecef;
  const double depth = d.dot(line);
  if (!(depth > 0.0)) return false;
  const double spread_m = position_sd_m + std::abs(dt_s) * velocity_sd_m_s;
  const double angle = std::sqrt(sighting.sight.covariance_white.trace() +
                                 sighting.sight.covariance_systematic.trace());
  constexpr double kGenerous = 8.0, kLeastRad = 0.02;
  return (line - depth * d).norm() < kGenerous * (spread_m + depth * angle) + depth * kLeastRad;
}

TrackKeeper::TrackKeeper(const KeeperConfig& config)
    : config_(config),
      birth_(config.birth, filter_config(config)),
      errors_(config.errors),
      rivals_(config.rivals) {}

std::vector<TrackKeeper::Candidate> TrackKeeper::candidates(const Sighting& sighting,
                                                            bool confirmed) const {
  std::vector<Candidate> found;
  if (tracks_.empty()) return found;
  const Eigen::Vector3d direction = direction_ecef(sighting.sight);
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    if (!glances_[i].may_see(sighting, direction)) continue;
    const Track& track = tracks_[i];
    if (is_sure(track) != confirmed || track.state == TrackState::kDropped) continue;
    if (track.has_taken(sighting)) continue;
    Innovation seen = track.filter.innovation(sighting, errors_);
    if (seen.nis < config_.filter.gate_nis) found.push_back({i, std::move(seen)});
  }
  std::ranges::sort(found, {}, [](const Candidate& c) { return c.seen.nis; });
  return found;
}

Track* TrackKeeper::follower(const Sighting& sighting) {
  if (sighting.track_id == 0) return nullptr;
  const FollowedObjects::Object* const own = followed_.find(sighting);
  if (own == nullptr) return nullptr;
  const auto track =
      std::ranges::find_if(tracks_, [&](const Track& t) { return is_sure(t) && t.id == own->id; });
  return track == tracks_.end() ? nullptr : &*track;
}

Association TrackKeeper::add(const Sighting& sighting, bool may_begin) {
  if (config_.one_target) return add_to_one(sighting, may_begin);
  for (const bool confirmed : {true, false}) {
    const auto near = candidates(sighting, confirmed);
    if (near.empty()) continue;
    if (confirmed) note_rivals(sighting, near);
    Track* const own = follower(sighting);
    const auto by_id =
        std::ranges::find_if(near, [&](const Candidate& c) { return &tracks_[c.track] == own; });
    if (by_id != near.end()) return give_to(*own, sighting, &by_id->seen);
    if (confirmed && near.size() > 1 &&
        near[1].seen.nis - near[0].seen.nis < config_.ambiguous_nis) {
      ++counts_.ambiguous;
      return {Association::Kind::kAmbiguous, 0};
    }
    return give_to(tracks_[near[0].track], sighting, &near[0].seen);
  }
  // A station that follows an object follows it still, if a little wildly: told to the filter, so
  // that it learns when the target has gone beyond its models.
  if (Track* const own = follower(sighting); own != nullptr) {
    const Association result = give_to(*own, sighting);
    if (result.kind == Association::Kind::kTrack) return result;
  }
  ++counts_.unexplained;
  const bool room = static_cast<int>(tracks_.size()) < config_.max_tracks;
  return may_begin && room ? begin(sighting) : Association{};
}

void TrackKeeper::note_rivals(const Sighting& sighting, const std::vector<Candidate>& near) {
  if (near.size() < 2 && rivals_.empty()) return;
  std::vector<std::int64_t> ids;
  for (const Candidate& candidate : near) {
    const Track& track = tracks_[candidate.track];
    if (track.state == TrackState::kConfirmed) ids.push_back(track.id);
  }
  rivals_.note(sighting, ids);
}

Association TrackKeeper::begin(const Sighting& sighting) {
  auto start = birth_.add(sighting, errors_, false);
  if (!start) return {};
  errors_.learn(start->shown);
  ++counts_.born;
  tracks_.push_back(std::move(start->track));
  glances_.push_back(glance_at(tracks_.back()));
  Track& begun = tracks_.back();
  consider(begun);
  // It may be that of a station which has waited for its turn.
  return begun.has_taken(sighting) ? Association{Association::Kind::kTrack, begun.id}
                                   : Association{};
}

Association TrackKeeper::give_to(Track& track, const Sighting& sighting, const Innovation* seen) {
  const FilterUpdate update = track.filter.update(sighting, errors_, seen);
  errors_.learn(update.shown);
  const BearingUse use = update.use;
  glances_[static_cast<std::size_t>(&track - tracks_.data())] = glance_at(track);
  // One more than the filter has states for is of the target all the same, and begins no other.
  if (use != BearingUse::kUsed && use != BearingUse::kNoPlace) {
    ++track.misses;
    ++counts_.set_aside;
    return {Association::Kind::kSetAside, track.id};
  }
  ++track.hits[sighting.station];
  keep(track, sighting);
  follow(sighting, track);
  if (stations_lately(track.filter, config_.seen_s) >= 2) {
    track.located_us = track.filter.utime_us();
    if (track.state == TrackState::kCoasted) track.state = TrackState::kConfirmed;
  }
  const std::int64_t id = track.id;
  if (track.state == TrackState::kBorn) consider(track);
  return {Association::Kind::kTrack, id};
}

void TrackKeeper::keep(Track& track, const Sighting& sighting) const {
  auto& own = track.bearings[sighting.station];
  const auto place = std::ranges::upper_bound(own, sighting.utime_us, {}, &Sighting::utime_us);
  own.insert(place, sighting);
  const auto span_us = static_cast<std::int64_t>(config_.memory_s * 1e6);
  const std::int64_t oldest_us = own.back().utime_us - span_us;
  const auto kept = std::ranges::lower_bound(own, oldest_us, {}, &Sighting::utime_us);
  constexpr std::ptrdiff_t kTogether = 16;  // each one by itself would move all others every time
  if (kept - own.begin() >= kTogether) own.erase(own.begin(), kept);
}

bool TrackKeeper::worth_confirming(const Track& track) const {
  const KinematicState now = track.filter.at(track.filter.utime_us());
  if (judge_position(track.filter, now) != Solution::kOk) return false;
  if (config_.one_target) return true;
  int stations = 0, of_a_pair = 0, hits = 0;
  for (const auto& [name, count] : track.hits) {
    stations += count >= config_.confirm_hits ? 1 : 0;
    of_a_pair += count >= config_.confirm_pair_hits ? 1 : 0;
    hits += count;
  }
  if (track.misses > hits) return false;
  if (stations >= config_.confirm_stations) return true;
  return of_a_pair >= 2 && seconds(track.filter.utime_us() - track.born_us) >= config_.confirm_s;
}

// Nearer to each other than both know.
bool TrackKeeper::are_alike(const Track& track, const Track& other) {
  const KinematicState own = track.filter.at(track.filter.utime_us());
  const KinematicState there = other.filter.at(own.utime_us);
  const Eigen::Matrix<double, 6, 1> off = (own.mean - there.mean).head<6>();
  const Eigen::Matrix<double, 6, 6> P = (own.covariance + there.covariance).topLeftCorner<6, 6>();
  constexpr double kAlike = 22.5;  // chi^2 of 6 degrees of freedom, 0.999
  return off.dot(P.ldlt().solve(off)) < kAlike;
}

// The same object as a sure one.
bool TrackKeeper::is_double(const Track& track) const {
  return std::ranges::any_of(tracks_, [&](const Track& other) {
    return &other != &track && is_sure(other) && are_alike(track, other);
  });
}

void TrackKeeper::consider(Track& track) {
  if (!worth_confirming(track)) return;
  if (is_double(track)) {
    track.state = TrackState::kDropped;
    return;
  }
  confirm(track);
}

void TrackKeeper::confirm(Track& track) {
  track.state = TrackState::kConfirmed;
  ++counts_.confirmed;
  if (track.id == 0) take_identity(track);
  for (const auto& [station, bearings] : track.bearings) {
    if (!bearings.empty()) follow(bearings.back(), track);
  }
  if (!config_.one_target) birth_.give(track, errors_);
}

// What a station's other tracks have taught of it stays true: they go on with it.
void TrackKeeper::forget_what_it_taught(const Track& track) {
  const auto has_another = [&](const std::string& station) {
    return std::ranges::any_of(tracks_, [&](const Track& other) {
      return &other != &track && is_sure(other) && other.bearings.contains(station) &&
             !are_made_to_meet(other.filter);
    });
  };
  for (const FilterStation& station : track.filter.stations()) {
    if (!has_another(station.station)) errors_.forget(station.station);
  }
}

void TrackKeeper::age(Track& track, std::int64_t now_us) {
  if (are_made_to_meet(track.filter)) {  // what it has taught of them is not true, either
    forget_what_it_taught(track);
    track.state = TrackState::kDropped;
    return;
  }
  const double unseen_s = seconds(now_us - track.located_us);
  if (track.state == TrackState::kBorn) {
    if (unseen_s > config_.born_drop_s && !config_.one_target) track.state = TrackState::kDropped;
    if (unseen_s > config_.drop_s) track.state = TrackState::kDropped;
    return;
  }
  if (unseen_s > config_.coast_s) {
    // The room that was given them has not helped, either.
    const bool parted =
        !config_.one_target && set_aside_in_a_row(track.filter, now_us) >= 2 * kPartedBearings;
    track.state = parted ? TrackState::kDropped : TrackState::kCoasted;
  }
  if (unseen_s <= config_.drop_s) return;
  // One station alone is no position for long; of a recording's one object it is known by its own
  // covariance for how long.
  if (!config_.one_target) {
    track.state = TrackState::kDropped;
    return;
  }
  const bool silent = stations_lately(track.filter, config_.drop_s) == 0 ||
                      seconds(now_us - track.filter.utime_us()) > config_.drop_s;
  const bool lost =
      doubted() || judge_position(track.filter, track.filter.at(now_us)) != Solution::kOk;
  if (silent || lost) track.state = TrackState::kDropped;
}

void TrackKeeper::advance(std::int64_t now_us) {
  for (Track& track : tracks_) {
    if (track.state != TrackState::kDropped) age(track, now_us);
  }
  for (const auto& [older, younger] : rivals_.same()) merge(older, younger);
  for (Track& track : tracks_) {
    if (track.state != TrackState::kDropped) continue;
    ++counts_.dropped;
    if (track.id != 0) dropped_.push_back(track);
  }
  std::erase_if(tracks_, [](const Track& t) { return t.state == TrackState::kDropped; });
  glances_.clear();
  for (const Track& track : tracks_) glances_.push_back(glance_at(track));
  std::erase_if(dropped_, [&](const Track& old) {
    const bool too_long = seconds(now_us - old.located_us) > config_.remember_s + config_.drop_s;
    return too_long && !config_.one_target;
  });
  while (dropped_.size() > 64) dropped_.pop_front();
}

std::optional<TrackKeeper::Nearest> TrackKeeper::nearest(const Sighting& sighting) const {
  const RayFrame frame = ray_frame(sighting.sight);
  std::optional<Nearest> best;
  for (const Track& track : tracks_) {
    if (track.state != TrackState::kConfirmed) continue;
    const KinematicState& state = track.filter.summary();
    const double dt_s = seconds(sighting.utime_us - state.utime_us);
    const Eigen::Vector3d line =
        state.mean.head<3>() + dt_s * state.mean.segment<3>(3) - sighting.sight.origin_ecef;
    const double depth = frame.direction.dot(line);
    if (!(depth > 0.0)) continue;
    const Eigen::Vector2d off = frame.tangent.transpose() * line / depth;
    if (!best || off.norm() < best->off_rad.norm()) best = Nearest{track.id, off};
  }
  return best;
}

void TrackKeeper::forget_station(const std::string& station) {
  errors_.forget(station);
  birth_.forget(station);
  followed_.forget(station);
}

void TrackKeeper::clear() {
  const std::int64_t next_id = next_id_;
  *this = TrackKeeper(config_);
  next_id_ = next_id;
}

}  // namespace ols
