#include "central/tracking/recorded_track.h"

#include <algorithm>
#include <limits>

#include "central/measurement/time_span.h"
#include "central/tracking/likeness.h"
#include "central/tracking/position_guard.h"

namespace ols::fusion {
namespace {

constexpr double kDoubtS = 1.0;  // after a wrong pair, before two other rays begin a track

// A recording has one object, so two stations always see the same one, however large the correction
// of their headings.
FilterConfig filter_of(const TrackManagerConfig& config) {
  FilterConfig filter = config.filter;
  filter.two_stations_nis = std::numeric_limits<double>::infinity();
  return filter;
}

}  // namespace

RecordedTrack::RecordedTrack(const TrackManagerConfig& config)
    : TrackManager(config, filter_of(config), false) {}

const Track* RecordedTrack::located() const {
  const auto found = std::ranges::find_if(tracks_, [](const Track& t) { return t.id != 0; });
  return found == tracks_.end() ? nullptr : &*found;
}

std::vector<Association> RecordedTrack::add(std::span<const BearingMeasurement> image,
                                            bool may_begin) {
  std::vector<Association> all;
  for (const BearingMeasurement& measurement : image)
    all.push_back(add_one(measurement, may_begin));
  return all;
}

Association RecordedTrack::add_one(const BearingMeasurement& measurement, bool may_begin) {
  Association given;
  if (!tracks_.empty()) {
    given = give_to(tracks_.front(), measurement);
    const bool used = given.kind == Association::Kind::kTrack;
    note(measurement, used);
    if (!used && !proved_) take_back(measurement.utime_us);
  }
  if (!may_begin) return given;
  if (!tracks_.empty() && proved_ && !most_stations_disagree()) {
    initiation_.store(measurement);
    return given;
  }
  confirm_by_initiation(measurement);
  const bool begun = given.kind == Association::Kind::kUnexplained && !tracks_.empty();
  return begun ? Association{Association::Kind::kTrack, tracks_.front().id} : given;
}

// By the number of bearings, not by time: stations may have any frame rate.
void RecordedTrack::note(const BearingMeasurement& measurement, bool used) {
  constexpr double kMemory = 8.0;
  Explains& own = explains_[measurement.station];
  own.newest_us = measurement.utime_us;
  own.share += ((used ? 1.0 : 0.0) - own.share) / kMemory;
}

// Counts the stations that recently delivered: those of whose bearings the track explains at least
// half, or the others.
int RecordedTrack::stations(bool explained) const {
  std::int64_t now_us = 0;
  for (const auto& [name, own] : explains_) now_us = std::max(now_us, own.newest_us);
  const auto span_us = static_cast<std::int64_t>(config_.drop_s * 1e6);
  return static_cast<int>(std::ranges::count_if(explains_, [&](const auto& entry) {
    const Explains& own = entry.second;
    return now_us - own.newest_us <= span_us && (own.share >= 0.5) == explained;
  }));
}

bool RecordedTrack::most_stations_disagree() const {
  const int against = stations(false);
  return against >= 2 && against >= stations(true);
}

// The rays that began the track were of two objects, or one was wrong.
void RecordedTrack::take_back(std::int64_t utime_us) {
  errors_ = errors_before_;
  taken_back_us_ = utime_us;
  tracks_.front().state = TrackState::kDeleted;
  advance(utime_us);
}

// Searches for an initial state on which the bearings of several stations agree: for a track on
// trial, for one with which most stations disagree, or if there is no track.
void RecordedTrack::confirm_by_initiation(const BearingMeasurement& measurement) {
  const bool none = tracks_.empty(), on_trial = !none && !proved_;
  const auto doubt_us = static_cast<std::int64_t>(kDoubtS * 1e6);
  const bool accept_two_rays =
      none && (!taken_back_us_ || measurement.utime_us - *taken_back_us_ > doubt_us);
  auto start = initiation_.add(measurement, on_trial ? errors_before_ : errors_, accept_two_rays);
  if (!start) return;
  if (none || is_better(start->track)) {
    if (accept_two_rays) errors_before_ = errors_;
    if (on_trial) errors_ = errors_before_;
    errors_.learn(start->evidence);
    explains_.clear();
    if (none) {
      begin(std::move(start->track));
    } else {
      replace(tracks_.front(), std::move(start->track));
    }
    if (tracks_.front().state == TrackState::kTentative) consider(tracks_.front());
  }
  proved_ = !accept_two_rays;
}

// Compared with the current track.
bool RecordedTrack::is_better(const Track& start) const {
  if (are_duplicates(start.filter, tracks_.front().filter)) return false;
  return !proved_ || static_cast<int>(start.hits.size()) > stations(true);
}

// One station alone determines no range. The motion models would invent one with false certainty,
// and with a wrong range the second station's bearings would be rejected when it returns.
bool RecordedTrack::is_lost(const Track&, double unseen_s, std::int64_t) const {
  return unseen_s > config_.drop_s;
}

}  // namespace ols::fusion
