#include "central/tracking/track_initiation.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "central/measurement/time_span.h"
#include "central/tracking/behind_land.h"
#include "central/tracking/position_guard.h"

namespace ols::fusion {
namespace {

constexpr std::size_t kMostStarts = 3;  // max hypotheses per bearing
constexpr int kMostRounds = 6;          // iterations over its bearings
constexpr double kLeastKnown = 1.0;     // max 1-sigma over range

}  // namespace

std::optional<TrackStart> TrackInitiation::search(const BearingMeasurement& measurement,
                                                  const BiasModel& errors, bool accept_two_rays) {
  failure_ = Solution::kTooFewRays;
  const std::vector<RayMeeting> starts = meetings_.of(measurement, pool_, errors, failure_);
  std::size_t tried = 0;
  for (const RayMeeting& start : starts) {
    if (tried == kMostStarts) break;
    auto begun =
        try_start(measurement, start, errors, accept_two_rays ? Needed::kTwoRays : Needed::kAll);
    if (begun && is_behind_land(begun->start.track.filter, config_.land.get())) {
      failure_ = Solution::kRaysMiss;
      continue;
    }
    ++tried;
    if (!begun) continue;
    if (!accept_two_rays && has_better_hypothesis(*begun, measurement, errors)) continue;
    if (!accept_two_rays) take(begun->start.track);
    return std::move(begun->start);
  }
  return std::nullopt;
}

std::optional<TrackStart> TrackInitiation::add(const BearingMeasurement& measurement,
                                               const BiasModel& errors, bool accept_two_rays) {
  store(measurement);
  const std::optional<BearingMeasurement> next = next_station_to_search(measurement);
  return next ? search(*next, errors, accept_two_rays) : std::nullopt;
}

// Each bearing pays for a search among kStationsABearing stations; beyond that, the station that
// has waited longest is searched next, from a random bearing of its newest frame. In a fixed order,
// a station's searches could stay in step with the others' and always get the same bearing.
std::optional<BearingMeasurement> TrackInitiation::next_station_to_search(
    const BearingMeasurement& measurement) {
  constexpr std::size_t kStationsABearing = 64;
  const std::size_t cost = pool_.stations().size();
  saved_ = std::min(saved_ + kStationsABearing, cost);
  if (waiting_.empty() && saved_ == cost) {
    saved_ = 0;
    return measurement;
  }
  if (std::ranges::find(waiting_, measurement.station) == waiting_.end()) {
    waiting_.push_back(measurement.station);
  }
  while (saved_ == cost && !waiting_.empty()) {
    const auto own = pool_.stations().find(waiting_.front());
    waiting_.pop_front();
    if (own == pool_.stations().end()) continue;
    saved_ = 0;
    const auto& looks = own->second.looks;
    const auto frame =
        std::ranges::lower_bound(looks, looks.back().utime_us, {}, &BearingSummary::utime_us) -
        looks.begin();
    const auto bearings = looks.size() - static_cast<std::size_t>(frame);
    return own->second.bearings[static_cast<std::size_t>(frame) + any_() % bearings];
  }
  return std::nullopt;
}

// Does one of its two stations agree better with a third?
bool TrackInitiation::has_better_hypothesis(const Hypothesis& begun,
                                            const BearingMeasurement& newest,
                                            const BiasModel& errors) {
  const auto& own = begun.start.track.hits;
  if (own.size() > 2) return false;
  for (const auto& [name, pooled] : pool_.stations()) {
    const BearingMeasurement& third = pooled.bearings.back();
    if (own.contains(name) ||
        std::abs(seconds(third.utime_us - newest.utime_us)) > config_.meeting.pair_s)
      continue;
    int tried = 0;
    for (const RayMeeting& start : meetings_.of(third, pool_, errors, failure_)) {
      if (!own.contains(start.second)) continue;
      const auto rival = try_start(third, start, errors, Needed::kHalf);
      const bool counts = rival && !is_behind_land(rival->start.track.filter, config_.land.get());
      if (counts && (rival->start.track.hits.size() > 2 || rival->misfit < begun.misfit)) {
        failure_ = Solution::kRaysMiss;
        return true;
      }
      if (++tried >= 3) break;
    }
  }
  return false;
}

namespace {

// One station's bearings with the same stamp.
struct Frame {
  std::int64_t utime_us = 0;
  std::vector<const BearingMeasurement*> bearings;
};

std::vector<Frame> frames_backwards(
    const std::vector<const UnassociatedBearings::Station*>& stations, std::int64_t oldest_us) {
  std::vector<Frame> frames;
  for (const UnassociatedBearings::Station* const station : stations) {
    for (const BearingMeasurement& measurement : station->bearings) {
      if (measurement.utime_us < oldest_us) continue;
      const bool same = !frames.empty() && frames.back().utime_us == measurement.utime_us &&
                        frames.back().bearings.front()->station == measurement.station;
      if (!same) frames.push_back({measurement.utime_us, {}});
      frames.back().bearings.push_back(&measurement);
    }
  }
  std::ranges::stable_sort(frames, std::greater<>(), &Frame::utime_us);
  return frames;
}

struct Explained {
  int frames = 0;
  double misfit = 0.0;  // sum of the squared normalised residuals, each limited to the gate
  std::vector<BearingMeasurement> bearings;  // the latest first
};

// Runs the filter over the frames: each contributes its nearest bearing, if that is in the gate.
std::map<std::string, Explained> explain(const std::vector<Frame>& frames, TrackFilter& filter,
                                         BiasModel& evidence) {
  std::map<std::string, Explained> stations;
  for (const Frame& frame : frames) {
    const BearingMeasurement* best = nullptr;
    Innovation least;
    least.nis = filter.config().gate_nis;
    for (const BearingMeasurement* measurement : frame.bearings) {
      Innovation seen = filter.innovation(*measurement, evidence);
      if (seen.nis >= least.nis) continue;
      least = std::move(seen);
      best = measurement;
    }
    Explained& station = stations[frame.bearings.front()->station];
    ++station.frames;
    station.misfit += least.nis;
    if (best == nullptr) continue;
    const FilterUpdate update = filter.update(*best, evidence, &least);
    evidence.learn(update.evidence);
    if (update.use != BearingUse::kUsed) continue;
    station.bearings.push_back(*best);
  }
  return stations;
}

struct Agreement {
  int hits = 0, frames = 0;
  double misfit = 0.0;
  std::int64_t oldest_us = 0;
};

// Gives the track the bearings of the stations that agree on it.
Agreement agree(std::map<std::string, Explained>& stations, double least_share, Track& track) {
  Agreement sum{.oldest_us = track.initiated_us};
  for (auto& [name, station] : stations) {
    const int here = static_cast<int>(station.bearings.size());
    if (here == 0 || here < least_share * station.frames) continue;
    sum.hits += here;
    sum.frames += station.frames;
    sum.misfit += station.misfit;
    sum.oldest_us = std::min(sum.oldest_us, station.bearings.back().utime_us);
    track.hits[name] = here;
    std::ranges::reverse(station.bearings);
    for (const BearingMeasurement& own : station.bearings) track.last.note(own);
    track.bearings[name] = std::move(station.bearings);
  }
  return sum;
}

// The update moved position and velocity by little, compared with their sigmas.
bool is_settled(const KinematicState& found, const Vector9& about) {
  constexpr double kNear = 0.1;  // squared, in sigmas
  const Eigen::Matrix<double, 6, 1> off = (found.mean - about).head<6>();
  const Eigen::Matrix<double, 6, 6> P = found.covariance.topLeftCorner<6, 6>();
  const double squared = off.dot(P.ldlt().solve(off));
  return squared >= 0.0 && squared < kNear;
}

}  // namespace

// Stations with a recent bearing towards the hypothesis: only their bearings can be explained by
// it.
std::vector<const UnassociatedBearings::Station*> TrackInitiation::looking_at(
    const RayMeeting& start, std::int64_t now_us) const {
  std::vector<const UnassociatedBearings::Station*> found;
  for (const auto& [name, own] : pool_.stations()) {
    const std::int64_t newest_us = own.looks.back().utime_us;
    bool looks = name == start.first || name == start.second;
    for (auto look = own.looks.rbegin(); !looks && look != own.looks.rend(); ++look) {
      if (seconds(newest_us - look->utime_us) > config_.meeting.pair_s) break;
      const double dt_s = std::abs(seconds(now_us - look->utime_us));
      looks = look->is_near(start.p_ecef, meetings_.moved_rad(dt_s + look->clock_sd_s));
    }
    if (looks) found.push_back(&own);
  }
  return found;
}

// The newest instant of the stations that have a bearing near this time.
std::int64_t TrackInitiation::now_at(std::int64_t utime_us) const {
  std::int64_t now_us = utime_us;
  for (const auto& [station, own] : pool_.stations()) {
    const std::int64_t newest_us = own.looks.back().utime_us;
    if (std::abs(seconds(newest_us - utime_us)) <= config_.meeting.pair_s) {
      now_us = std::max(now_us, newest_us);
    }
  }
  return now_us;
}

// Runs the filter backwards over the kept bearings, from `now_us` on, and returns it with the used
// bearings of the stations that agree on the hypothesis. Nullopt if it diverges.
std::optional<TrackInitiation::Hypothesis> TrackInitiation::run(const RayMeeting& start,
                                                                std::int64_t now_us,
                                                                const BiasModel& errors) const {
  auto frames = frames_backwards(looking_at(start, now_us),
                                 now_us - static_cast<std::int64_t>(config_.pool_s * 1e6));
  // The first state is vague and moves to the first bearings, so the two stations that made it come
  // first.
  std::stable_partition(frames.begin(), frames.end(), [&](const Frame& frame) {
    const std::string& station = frame.bearings.front()->station;
    return station == start.first || station == start.second;
  });
  FilterStart from{.p_ecef = start.p_ecef,
                   .position_sd_m = start.range_m / 2.0,
                   .velocity_sd_m_s = 2.0 * config_.meeting.rate_sd_rad_s * start.range_m};
  std::optional<Hypothesis> begun;
  std::optional<KinematicState> about;
  std::map<std::string, Explained> stations;
  // Linearising about the vague first estimate can lead to a wrong one with false certainty. So
  // each iteration is linearised about the result of the one before.
  for (int round = 0; round < kMostRounds && !(begun && begun->settled); ++round) {
    begun.emplace(Hypothesis{
        TrackStart{Track(TrackFilter(filter_, now_us, from)), BiasModel::evidence_on(errors)}});
    TrackFilter& filter = begun->start.track.filter;
    if (about) filter.linearise_about(*about);
    stations = explain(frames, filter, begun->start.evidence);
    filter.linearise_about_itself();
    const KinematicState found = filter.at(now_us);
    if (!found.mean.allFinite()) return std::nullopt;
    begun->settled = about && is_settled(found, about->mean);
    about = found;
    from.p_ecef = found.mean.head<3>();
    from.v_ecef = found.mean.segment<3>(3);
  }
  begun->start.track.initiated_us = begun->start.track.last_two_station_us = now_us;
  const Agreement sum = agree(stations, config_.explained, begun->start.track);
  begun->bearings = sum.hits;
  begun->span_s = seconds(now_us - sum.oldest_us);
  begun->misfit = sum.misfit / sum.frames;
  return begun;
}

std::optional<TrackInitiation::Hypothesis> TrackInitiation::try_start(
    const BearingMeasurement& newest, const RayMeeting& start, const BiasModel& errors,
    Needed needed) {
  auto begun = run(start, now_at(newest.utime_us), errors);
  if (!begun) return std::nullopt;
  const std::size_t agreeing = begun->start.track.hits.size();
  failure_ = Solution::kRaysMiss;
  if (agreeing < 2) return std::nullopt;
  failure_ = Solution::kTooFewRays;
  const double long_s = config_.two_stations_s * (needed == Needed::kAll ? 1.0 : 0.5);
  const bool long_enough = agreeing > 2 || begun->span_s >= long_s;
  const bool enough = begun->bearings >= config_.least_bearings && long_enough;
  if (needed == Needed::kTwoRays) return begun;
  if (!enough) return std::nullopt;
  // Rays that are parallel by chance intersect far away: a hypothesis without a range explains
  // everything and would take the bearings of all nearer objects.
  const TrackFilter& filter = begun->start.track.filter;
  const bool is_somewhere = has_range(filter, filter.summary(), kLeastKnown);
  if (!is_somewhere) failure_ = Solution::kParallelRays;
  return is_somewhere && begun->settled ? std::move(begun) : std::nullopt;
}

void TrackInitiation::take(const Track& track) {
  for (const auto& [station, bearings] : track.bearings) {
    const auto& taken = bearings;  // clang 14 cannot capture a structured binding
    pool_.erase_if(station, [&](const BearingMeasurement& s) {
      return std::ranges::any_of(taken, [&](const BearingMeasurement& t) {
        return t.utime_us == s.utime_us &&
               t.sight.direction.azimuth_rad == s.sight.direction.azimuth_rad &&
               t.sight.direction.elevation_rad == s.sight.direction.elevation_rad;
      });
    });
  }
}

void TrackInitiation::give(const Track& track, const BiasModel& errors) {
  std::vector<std::string> stations;
  for (const auto& [station, own] : pool_.stations()) {
    const bool looks = std::ranges::any_of(own.looks, [&](const BearingSummary& look) {
      const double dt_s = std::abs(seconds(look.utime_us - track.filter.utime_us()));
      return look.is_near(track.filter.position(), meetings_.moved_rad(dt_s + look.clock_sd_s));
    });
    if (looks) stations.push_back(station);
  }
  for (const std::string& station : stations) {
    pool_.erase_if(station, [&](const BearingMeasurement& measurement) {
      return track.filter.innovation(measurement, errors).nis < filter_.robust_nis;
    });
  }
}

Solution TrackInitiation::why_none(std::int64_t now_us) const {
  const auto heard = std::ranges::count_if(pool_.stations(), [&](const auto& station) {
    return seconds(now_us - station.second.looks.back().utime_us) <= config_.pool_s;
  });
  if (heard == 0) return Solution::kTooFewRays;
  return heard == 1 ? Solution::kBearingOnly : failure_;
}

}  // namespace ols::fusion
