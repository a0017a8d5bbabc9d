#include "central/tracking/live_tracks.h"

#include <algorithm>
#include <utility>

#include "central/measurement/time_span.h"
#include "central/tracking/position_guard.h"

namespace ols::fusion {

LiveTracks::LiveTracks(const TrackManagerConfig& config)
    : TrackManager(config, config.filter, true), duplicates_(config.duplicates) {}

std::vector<LiveTracks::Candidate> LiveTracks::candidates(const BearingMeasurement& measurement,
                                                          bool confirmed) const {
  std::vector<Candidate> found;
  if (tracks_.empty()) return found;
  const Eigen::Vector3d direction = direction_ecef(measurement.sight);
  const double off_rad = may_be_off_rad(measurement.sight);
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    if (!glances_[i].may_see(measurement, direction, off_rad)) continue;
    const Track& track = tracks_[i];
    if (is_established(track) != confirmed || track.state == TrackState::kDeleted) continue;
    if (track.has_taken(measurement)) continue;
    Innovation seen = track.filter.innovation(measurement, errors_);
    if (seen.nis < config_.filter.gate_nis) found.push_back({i, std::move(seen)});
  }
  std::ranges::sort(found, {}, [](const Candidate& c) { return c.seen.nis; });
  return found;
}

Association LiveTracks::add(const BearingMeasurement& measurement, bool may_begin) {
  for (const bool confirmed : {true, false}) {
    const auto near = candidates(measurement, confirmed);
    if (near.empty()) continue;
    if (confirmed) note_duplicates(measurement, near);
    Track* const own = identities_.follower(measurement, tracks_);
    const auto by_id =
        std::ranges::find_if(near, [&](const Candidate& c) { return &tracks_[c.track] == own; });
    if (by_id != near.end()) return give_to(*own, measurement, &by_id->seen);
    if (confirmed && near.size() > 1 &&
        near[1].seen.nis - near[0].seen.nis < config_.ambiguous_nis) {
      ++counts_.ambiguous;
      return {Association::Kind::kAmbiguous, 0};
    }
    return give_to(tracks_[near[0].track], measurement, &near[0].seen);
  }
  // A station that follows an object still follows it, even if its bearings scatter. The filter
  // gets the bearing, so that it detects a manoeuvre beyond its models.
  if (Track* const own = identities_.follower(measurement, tracks_); own != nullptr) {
    const Association result = give_to(*own, measurement);
    if (result.kind == Association::Kind::kTrack) return result;
  }
  ++counts_.unexplained;
  const bool room = static_cast<int>(tracks_.size()) < config_.max_tracks;
  return may_begin && room ? initiate(measurement) : Association{};
}

void LiveTracks::note_duplicates(const BearingMeasurement& measurement,
                                 const std::vector<Candidate>& near) {
  if (near.size() < 2 && duplicates_.empty()) return;
  std::vector<std::int64_t> ids;
  for (const Candidate& candidate : near) {
    const Track& track = tracks_[candidate.track];
    if (track.state == TrackState::kConfirmed) ids.push_back(track.id);
  }
  duplicates_.note(measurement, ids);
}

Association LiveTracks::initiate(const BearingMeasurement& measurement) {
  auto start = initiation_.add(measurement, errors_, false);
  if (!start) return {};
  errors_.learn(start->evidence);
  Track& begun = begin(std::move(start->track));
  consider(begun);
  // It may be one of a station that has waited for its search.
  return begun.has_taken(measurement) ? Association{Association::Kind::kTrack, begun.id}
                                      : Association{};
}

bool LiveTracks::is_worth_confirming(const Track& track) const {
  int stations = 0, of_a_pair = 0, hits = 0;
  for (const auto& [name, count] : track.hits) {
    stations += count >= config_.confirm_hits ? 1 : 0;
    of_a_pair += count >= config_.confirm_pair_hits ? 1 : 0;
    hits += count;
  }
  if (track.misses > hits) return false;
  if (stations >= config_.confirm_stations) return true;
  return of_a_pair >= 2 &&
         seconds(track.filter.utime_us() - track.initiated_us) >= config_.confirm_s;
}

bool LiveTracks::is_tentative_lost(double unseen_s) const {
  return unseen_s > config_.tentative_delete_s || unseen_s > config_.drop_s;
}

// One station alone gives a position only for a short time; less, if its bearings disagree with the
// others' although the covariance was inflated.
bool LiveTracks::is_lost(const Track& track, double unseen_s, std::int64_t now_us) const {
  const bool parted = unseen_s > config_.coast_s &&
                      consecutive_rejections(track.filter, now_us) >= 2 * kMaxConsecutiveRejections;
  return parted || unseen_s > config_.drop_s;
}

void LiveTracks::merge_duplicates() {
  for (const auto& [older, younger] : duplicates_.same()) merge(older, younger);
}

// Two tracks are one object. The one with more of its bearings stays, with the older identity.
void LiveTracks::merge(std::int64_t older, std::int64_t younger) {
  duplicates_.forget(younger);
  const auto own = std::ranges::find(tracks_, older, &Track::id);
  const auto other = std::ranges::find(tracks_, younger, &Track::id);
  if (own == tracks_.end() || other == tracks_.end() || !is_established(*own) ||
      !is_established(*other))
    return;
  const auto bearings = [](const Track& track) {
    std::size_t sum = 0;
    for (const auto& [station, kept] : track.bearings) sum += kept.size();
    return sum;
  };
  if (bearings(*other) > bearings(*own)) std::swap(*own, *other);
  own->id = older;
  other->id = 0;
  other->state = TrackState::kDeleted;
  identities_.merge(older, younger);
  constexpr std::size_t kKeptMerged = 64;  // live, nobody takes them
  if (merged_.size() == kKeptMerged) merged_.erase(merged_.begin());
  merged_.emplace_back(older, younger);
  ++counts_.merged;
}

void LiveTracks::clear() {
  clear_tracks();
  duplicates_ = DuplicateTracks(config_.duplicates);
  merged_.clear();
}

}  // namespace ols::fusion
