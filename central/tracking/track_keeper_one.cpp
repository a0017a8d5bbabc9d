// TrackKeeper for a recording of one object.
#include <algorithm>

#include "central/tracking/track_keeper.h"

namespace ols {

Association TrackKeeper::add_to_one(const Sighting& sighting, bool may_begin) {
  Association given;
  if (!tracks_.empty()) {
    given = give_to(tracks_.front(), sighting);
    const bool used = given.kind == Association::Kind::kTrack;
    note(sighting, used);
    if (!used && !proved_) take_back(sighting.utime_us);
  }
  if (!may_begin) return given;
  if (!tracks_.empty() && proved_ && !doubted()) {
    birth_.store(sighting);
    return given;
  }
  prove(sighting);
  const bool begun = given.kind == Association::Kind::kUnexplained && !tracks_.empty();
  return begun ? Association{Association::Kind::kTrack, tracks_.front().id} : given;
}

// By the number of bearings, not by time: stations may be as slow as they like.
void TrackKeeper::note(const Sighting& sighting, bool used) {
  constexpr double kMemory = 8.0;
  Explains& own = explains_[sighting.station];
  own.newest_us = sighting.utime_us;
  own.share += ((used ? 1.0 : 0.0) - own.share) / kMemory;
}

// Stations that have delivered lately, most of whose bearings the track explains, or does not.
int TrackKeeper::stations(bool explained) const {
  std::int64_t now_us = 0;
  for (const auto& [name, own] : explains_) now_us = std::max(now_us, own.newest_us);
  const auto span_us = static_cast<std::int64_t>(config_.drop_s * 1e6);
  return static_cast<int>(std::ranges::count_if(explains_, [&](const auto& entry) {
    const Explains& own = entry.second;
    return now_us - own.newest_us <= span_us && (own.share >= 0.5) == explained;
  }));
}

bool TrackKeeper::doubted() const {
  const int against = stations(false);
  return against >= 2 && against >= stations(true);
}

// The rays on which the track began were not of one object, or one of them was wrong.
void TrackKeeper::take_back(std::int64_t utime_us) {
  errors_ = errors_before_;
  taken_back_us_ = utime_us;
  tracks_.front().state = TrackState::kDropped;
  advance(utime_us);
}

// Looks for a start that the bearings of several stations agree on: for the track on trial, for one
// that most do not agree with, or where there is none.
void TrackKeeper::prove(const Sighting& sighting) {
  const bool none = tracks_.empty();
  const auto doubt_us = static_cast<std::int64_t>(config_.doubt_s * 1e6);
  const bool trusting = none && (!taken_back_us_ || sighting.utime_us - *taken_back_us_ > doubt_us);
  const bool on_trial = !none && !proved_;
  auto found = birth_.add(sighting, on_trial ? errors_before_ : errors_, trusting);
  if (!found) return;
  Track* const start = &found->track;
  if (none || is_better(*start)) {
    if (trusting) errors_before_ = errors_;
    if (on_trial) errors_ = errors_before_;
    errors_.learn(found->shown);
    explains_.clear();
    if (none) {
      ++counts_.born;
      tracks_.push_back(std::move(*start));
    } else {
      start->id = tracks_.front().id;
      start->state = tracks_.front().state;
      tracks_.front() = std::move(*start);
    }
    glances_ = {glance_at(tracks_.front())};
    if (tracks_.front().state == TrackState::kBorn) consider(tracks_.front());
  }
  proved_ = !trusting;
}

// Than the track that there is.
bool TrackKeeper::is_better(const Track& start) const {
  if (are_alike(start, tracks_.front())) return false;
  return !proved_ || static_cast<int>(start.hits.size()) > stations(true);
}

}  // namespace ols
