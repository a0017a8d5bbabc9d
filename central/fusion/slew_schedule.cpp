#include "central/fusion/slew_schedule.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numeric>
#include <tuple>

#include "central/fusion/output_period.h"
#include "central/measurement/ray.h"
#include "central/measurement/time_span.h"

namespace ols::fusion {
namespace {

constexpr int kStationsABearing = 16;
constexpr double kStepBack_s = 0.5;
constexpr double kTurn_s = 5.0;          // a line is searched so long before another has its turn
constexpr double kLastTracker_s = 60.0;  // a tracker stays so long with what was a target

CueRay cue_ray(const BearingOnly& line, const Sighted& seen, std::int64_t now_us) {
  const RayFrame frame = ray_frame(line.sight);
  const Eigen::Matrix2d covariance = line.sight.covariance_white + line.sight.covariance_systematic;
  return {line.station,
          line.track_id,
          now_us,
          line.sight.origin_ecef,
          frame.direction,
          frame.tangent * line.rate_rad_s,
          std::sqrt(covariance.trace() / 2.0),
          seen.size_rad,
          seen.size_sd_rad};
}

// An operator has designated the object.
bool is_wanted(const BearingMeasurement& line) { return !line.is_tracklet && !line.is_acquired; }

}  // namespace

// A station whose target leads nobody counts as seeing no target.
SlewStation SlewSchedule::station_of(const std::string& name, const KnownStation& station,
                                     std::int64_t now_us) const {
  const std::int64_t seen = station.follows(now_us);
  const auto priority = round_.priority.find(seen);
  const bool leads = priority == round_.priority.end() || priority->second > 0.0;
  const auto let_go = let_go_.find(name);
  const auto lent = lent_.find(name);
  const bool is_lent = lent != lent_.end() && lent->second == seen;
  return {name, station.traits, leads && !is_lent ? seen : 0,
          std::ranges::find(staring_, name) != staring_.end(),
          let_go == let_go_.end() ? 0 : let_go->second};
}

// The stations that see a target, but are given to another one or to a line.
void SlewSchedule::find_lent_stations(std::int64_t now_us, const StationRegistry& stations) {
  lent_.clear();
  for (const auto& [name, station] : stations.all()) {
    const std::int64_t seen = station.follows(now_us);
    const auto own = round_.allocation.find(name);
    const bool is_elsewhere = own != round_.allocation.end() && own->second != seen;
    if (round_.targets.contains(seen) && is_elsewhere) lent_[name] = seen;
  }
}

// A tracker stays with its target until a slew lets it go. What an operator has designated is let
// go only if an operator dismisses it.
void SlewSchedule::find_what_is_let_go(const std::vector<Track>& tracks,
                                       const HandoverPolicy& handover) {
  for (const Track& track : tracks) {
    const bool is_dismissed = handover.is_dismissed(track.id);
    const bool is_let_go = is_dismissed || handover.is_let_go(track.id);
    for (const auto& [station, bearings] : track.bearings) {
      const auto lent = lent_.find(station);
      if (!is_let_go && (lent == lent_.end() || lent->second != track.id)) continue;
      const BearingMeasurement* own = tracker_of(track, station, round_.now_us);
      if (own != nullptr && (own->is_acquired || is_dismissed)) let_go_[station] = own->track_id;
    }
  }
}

void SlewSchedule::begin(std::int64_t now_us, const StationRegistry& stations,
                         const BearingLines& lines, const std::vector<Track>& tracks,
                         const CueRegistry& cues, const HandoverPolicy& handover) {
  const double since_s =
      begun_us_ ? std::clamp(seconds(now_us - *begun_us_), 0.0, give_up_s_) : 0.0;
  begun_us_ = now_us;
  next_ = "";
  round_ = {.now_us = now_us};
  for (const Track& track : tracks) {
    round_.priority[track.id] = handover.priority(track);
    if (handover.is_wanted(track.id)) round_.wanted.insert(track.id);
  }
  let_go_.clear();
  std::vector<SlewStation> all;
  all.reserve(stations.all().size());
  for (const auto& [name, station] : stations.all()) {
    all.push_back(station_of(name, station, now_us));
    if (all.back().follows != 0) ++round_.seen_by[all.back().follows];
  }
  round_.cues = cues.aims(now_us);
  std::ranges::move(handover.lost(now_us), std::back_inserter(round_.cues));
  note_targets(tracks);
  for (auto& [name, tracklet] : tracklets_) {
    if (handover.is_dismissed(tracklet.target)) tracklet.stays_s = 0.0;
  }
  cue(now_us, lines, all);
  note_search(since_s);
  if (round_.ray) {
    expect_range(all);
    narrow_by_cue();
  }
  planner_.allocate(round_, all, tracks);
  find_lent_stations(now_us, stations);
  find_what_is_let_go(tracks, handover);
  if (round_.ray) share_out(all);
}

// The line of this station to be searched: that of a designated object, else the one searched for
// the fewest turns, of these the oldest. Null: none.
const BearingMeasurement* SlewSchedule::line_of(const std::string& station,
                                                const std::vector<const BearingMeasurement*>& own) {
  const auto told = std::ranges::find_if(own, [](const auto* line) { return is_wanted(*line); });
  if (told != own.end()) return *told;
  const BearingMeasurement* best = nullptr;
  int fewest = 0;
  for (const BearingMeasurement* line : own) {  // each is noted
    const auto turn = turn_of({station, line->track_id});
    if (!line->is_tracklet) note_acquired(*line);
    if (!turn || (best != nullptr && *turn >= fewest)) continue;
    best = line;
    fewest = *turn;
  }
  return best;
}

// The object of a target needs no search for its position. If the target is lost, a search may
// begin then, unless the target leads nobody.
void SlewSchedule::note_targets(const std::vector<Track>& tracks) {
  for (const Track& track : tracks) {
    if (!is_established(track)) continue;
    const bool leads = round_.priority.at(track.id) > 0.0;
    for (const auto& [station, bearings] : track.bearings) {
      for (const BearingMeasurement* own : {newest_of(track, bearings, true, round_.now_us),
                                            newest_of(track, bearings, false, round_.now_us)}) {
        if (own == nullptr || is_wanted(*own)) continue;
        Tracklet& noted = tracklets_[{station, own->track_id}];
        noted = {round_.now_us, round_.now_us};
        if (leads) {
          noted.target = track.id;
          noted.stays_s = kLastTracker_s;
        } else {
          noted.searched_s = kSearched_s;
        }
      }
    }
  }
}

// An object that a led station's tracker has acquired and no other station sees. The tracker stays
// with it for the time of a line search. If the object was a target, the tracker stays longer,
// because it may be the last to see it; but not for ever, because it may have slid onto something
// else.
void SlewSchedule::note_acquired(const BearingMeasurement& line) {
  const Tracklet& known = tracklets_.at({line.station, line.track_id});
  if (seconds(round_.now_us - known.noted_us) < known.stays_s) {
    round_.bearing_only_stations.insert(line.station);
    round_.busy.insert(line.station);
  } else {
    let_go_[line.station] = line.track_id;
  }
}

// A search waits at first: other stations may be about to see the object where they look. It also
// ends: the object may be anything, and hidden from all other stations.
std::optional<int> SlewSchedule::turn_of(const TrackletName& tracklet) {
  constexpr double kWait_s = 0.7;
  const std::int64_t now_us = round_.now_us;
  Tracklet& known = tracklets_.try_emplace(tracklet, Tracklet{now_us}).first->second;
  known.seen_us = now_us;
  if (seconds(now_us - known.noted_us) < kWait_s || known.searched_s >= kSearched_s) {
    return std::nullopt;
  }
  return static_cast<int>(known.searched_s / kTurn_s);
}

// Designated objects come first, then those searched for the fewest turns. Among these, lines of
// stations that are never led come first: what a led station sees alone, although others look there
// too, is beyond the site. The line of the previous round stays unless another one is ahead of it,
// because a change restarts all searches.
void SlewSchedule::cue(std::int64_t now_us, const BearingLines& lines,
                       const std::vector<SlewStation>& stations) {
  constexpr double kForget_s = 2.0;  // after a tracklet has ended, or a target has taken it
  std::map<LineKey, SearchedLine> open;
  for (const std::string& station : lines.stations(now_us)) {
    const BearingMeasurement* own = line_of(station, lines.of(station, now_us));
    if (own == nullptr) continue;  // many detections, not an object that it follows
    const bool wanted = is_wanted(*own);
    if (wanted) {
      round_.bearing_only_stations.insert(station);
      round_.busy.insert(station);
    }
    const auto known = std::ranges::find(stations, station, &SlewStation::station);
    const bool is_new = !line_ || station != line_->second.ray.station;
    const LineKey key{!wanted, wanted ? 0 : turn_of({station, own->track_id}).value_or(0),
                      known != stations.end() && known->is_led(), is_new, station};
    if (!open.empty() && open.begin()->first < key) continue;
    if (const auto line = lines.at(*own, now_us)) {
      open[key] = {*own, cue_ray(*line, own->sighted, now_us)};
    }
  }
  std::erase_if(tracklets_, [&](const auto& tracklet) {
    return std::abs(seconds(now_us - tracklet.second.seen_us)) > kForget_s;
  });
  keep_line(now_us, lines, open);
  line_.reset();
  if (open.empty()) return;
  line_ = *open.begin();
  round_.ray = line_->second.ray.at(now_us);
  round_.bearing_only_stations.insert(round_.ray->station);
}

// A detector misses its object now and then. Meanwhile the search goes on along the predicted line.
void SlewSchedule::keep_line(std::int64_t now_us, const BearingLines& lines,
                             std::map<LineKey, SearchedLine>& open) const {
  constexpr double kGap_s = 1.0;
  if (!line_) return;
  const CueRay& ray = line_->second.ray;
  const auto is_it = [&](const auto& one) { return one.second.ray.station == ray.station; };
  if (std::ranges::any_of(open, is_it) || seconds(now_us - ray.utime_us) > kGap_s ||
      lines.is_taken(line_->second.newest, now_us)) {
    return;
  }
  LineKey key = line_->first;
  if (const auto known = tracklets_.find({ray.station, ray.track_id}); known != tracklets_.end()) {
    if (known->second.searched_s >= kSearched_s) return;
    std::get<1>(key) = static_cast<int>(known->second.searched_s / kTurn_s);
  }
  open.emplace(key, line_->second);
}

void SlewSchedule::note_search(double since_s) {
  if (!round_.ray) return;
  const auto searched = tracklets_.find({round_.ray->station, round_.ray->track_id});
  if (searched != tracklets_.end()) searched->second.searched_s += since_s;
}

// From the object's size, and from where the stations stand.
void SlewSchedule::expect_range(const std::vector<SlewStation>& stations) {
  const CueRay& ray = *round_.ray;
  std::vector<Eigen::Vector3d> places;
  for (const SlewStation& station : stations) {
    if (station.is_led() && !station.traits.camera_ecef.isZero()) {
      places.push_back(station.traits.camera_ecef);
    }
  }
  const auto by_size = range_by_size(ray);
  if (by_size) round_.prior = *by_size;
  if (places.empty()) return;
  const auto count = static_cast<double>(places.size());
  const Eigen::Vector3d middle =
      std::accumulate(places.begin(), places.end(), Eigen::Vector3d(0.0, 0.0, 0.0)) / count;
  double squared_m2 = 0.0;
  for (const Eigen::Vector3d& place : places) squared_m2 += (place - middle).squaredNorm() / count;
  constexpr double kLeastSd_m = 50.0;
  const LinePrior by_place{(middle - ray.origin_ecef).dot(ray.direction_ecef),
                           std::max(kLeastSd_m, std::sqrt(squared_m2) / 2.0)};
  round_.prior = by_size ? combined(*by_size, by_place) : by_place;
}

void SlewSchedule::share_out(const std::vector<SlewStation>& stations) {
  for (const SlewStation& station : stations) {
    const auto own = round_.allocation.find(station.station);
    const bool is_free =
        own == round_.allocation.end() ? station.follows == 0 : own->second == kOnLine;
    const bool searches = is_free && station.is_led() && !station.traits.camera_ecef.isZero() &&
                          !round_.bearing_only_stations.contains(station.station);
    const auto rank = static_cast<int>(round_.shares.size());
    if (searches) round_.shares.emplace(station.station, LineShare{rank, 0});
  }
  for (auto& [name, share] : round_.shares) share.of = static_cast<int>(round_.shares.size());
}

// If the ray passes a cue, the cue tells the range.
void SlewSchedule::narrow_by_cue() {
  constexpr double kSigmas = 3.0, kLeastSd_m = 10.0;
  const CueRay& ray = *round_.ray;
  for (const CueAim& aim : round_.cues) {
    const KinematicState cue = aim.at(round_.now_us);
    const Eigen::Vector3d line = cue.mean.head<3>() - ray.origin_ecef;
    const double range_m = line.dot(ray.direction_ecef);
    const double sd_m = std::sqrt(cue.covariance.topLeftCorner<3, 3>().trace() / 3.0);
    const double off_m = (line - range_m * ray.direction_ecef).norm();
    if (range_m <= 0.0 || off_m > kSigmas * std::hypot(sd_m, ray.sd_rad * range_m)) continue;
    round_.prior = {range_m, std::max(kLeastSd_m, sd_m)};
    round_.cue_on_ray = aim.cue.id;
    return;
  }
}

std::vector<Slew> SlewSchedule::plan(std::int64_t now_us, const StationRegistry& stations,
                                     const BearingLines& lines, const std::vector<Track>& tracks,
                                     const CueRegistry& cues, const HandoverPolicy& handover) {
  // Cues have another clock than bearings.
  if (begun_us_ && seconds(*begun_us_ - now_us) > kStepBack_s) {
    begun_us_.reset();
    next_.reset();
  }
  if (next_ && seconds(now_us - *begun_us_) > give_up_s_) next_.reset();
  if (!next_ && is_due(begun_us_, now_us, config_.rate_hz)) {
    begin(now_us, stations, lines, tracks, cues, handover);
  }
  if (!next_) return {};
  round_.now_us = now_us;  // a round may take a while; each slew is for the time of its creation
  std::vector<SlewStation> some;
  some.reserve(kStationsABearing);
  auto station = stations.all().lower_bound(*next_);
  for (; station != stations.all().end() && some.size() < kStationsABearing; ++station) {
    some.push_back(station_of(station->first, station->second, now_us));
  }
  next_.reset();
  if (station != stations.all().end()) next_ = station->first;
  return planner_.plan(round_, some, tracks);
}

}  // namespace ols::fusion
