#include "central/track_birth.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "geometry/angles.h"

namespace ols {
namespace {

constexpr std::size_t kMostStarts = 3;  // that are tried for one bearing

double seconds(std::int64_t span_us) { return static_cast<double>(span_us) * 1e-6; }

double apart_s(const Sighting& a, const Sighting& b) {
  return std::abs(seconds(a.utime_us - b.utime_us));
}

// Angle between a bearing's ray and a point; pi behind the camera.
double angle_off(const Sighting& sighting, const Eigen::Vector3d& p_ecef) {
  return angle_between(direction_ecef(sighting.sight), p_ecef - sighting.sight.origin_ecef);
}

}  // namespace

void TrackBirth::store(const Sighting& sighting) {
  auto& own = pool_[sighting.station];
  const auto later = [](std::int64_t utime_us, const Sighting& s) { return utime_us < s.utime_us; };
  own.insert(std::upper_bound(own.begin(), own.end(), sighting.utime_us, later), sighting);
  const std::int64_t oldest_us =
      own.back().utime_us - static_cast<std::int64_t>(config_.pool_s * 1e6);
  while (own.front().utime_us < oldest_us ||
         own.size() > static_cast<std::size_t>(config_.pool_of_a_station)) {
    own.pop_front();
  }
}

// How far off a bearing of one target may be: noise, bias, and motion between the two instants.
double TrackBirth::gate_rad(const Sighting& sighting, double dt_s, double range_m,
                            const StationErrors& errors) const {
  const BiasPrior bias = errors.prior(sighting.station, sighting.sight, std::max(1.0, range_m));
  const double variance =
      (sighting.sight.covariance_white + bias.covariance).trace() / 2.0 +
      std::pow(config_.rate_sd_rad_s * std::min(1.0, dt_s + sighting.clock_sd_s), 2);
  return config_.miss_sigma * std::sqrt(variance);
}

// Where two rays pass each other, if they do so in front of both cameras and near enough.
std::optional<TrackBirth::Meeting> TrackBirth::start_of(const Sighting& a, const Sighting& b,
                                                        const StationErrors& errors) {
  const Eigen::Vector3d u = direction_ecef(a.sight), v = direction_ecef(b.sight);
  const Eigen::Vector3d base = b.sight.origin_ecef - a.sight.origin_ecef;
  constexpr double kOnePlaceM = 0.01;
  const double along = u.dot(v), across = u.cross(v).squaredNorm();
  const double noise_rad = gate_rad(a, 0.0, 1e9, errors) + gate_rad(b, 0.0, 1e9, errors);
  if (across < noise_rad * noise_rad / 4.0 || base.norm() < kOnePlaceM) {
    failure_ = Solution::kParallelRays;
    return std::nullopt;
  }
  const double s = (base.dot(u) - along * base.dot(v)) / across;
  const double t = (along * base.dot(u) - base.dot(v)) / across;
  if (s <= 0.0 || t <= 0.0) {
    failure_ = Solution::kBehindCamera;
    return std::nullopt;
  }
  if (std::min(s, t) > filter_.max_range_m) {
    failure_ = Solution::kTooFar;
    return std::nullopt;
  }
  const Eigen::Vector3d on_a = a.sight.origin_ecef + s * u, on_b = b.sight.origin_ecef + t * v;
  const double dt_s = apart_s(a, b);
  const double miss_m = s * gate_rad(a, dt_s, s, errors) + t * gate_rad(b, 0.0, t, errors);
  if ((on_a - on_b).norm() > miss_m) {
    failure_ = Solution::kRaysMiss;
    return std::nullopt;
  }
  return Meeting{(on_a + on_b) / 2.0, std::min(s, t), a.station, b.station};
}

// Of a station's bearings near in time to another one, the one that is nearest to the start; the
// latest where there is no start yet.
const Sighting* TrackBirth::nearest(const std::deque<Sighting>& bearings, const Sighting& to,
                                    const Meeting* start, const StationErrors& errors) const {
  const Sighting* best = nullptr;
  double least = 1.0;
  for (auto it = bearings.rbegin(); it != bearings.rend(); ++it) {
    const double dt_s = apart_s(*it, to);
    if (dt_s > config_.pair_s) continue;
    if (start == nullptr) return &*it;
    const double off = angle_off(*it, start->p_ecef) / gate_rad(*it, dt_s, start->range_m, errors);
    if (off >= least) continue;
    least = off;
    best = &*it;
  }
  return best;
}

// Where the ray meets those of other stations; where more of the others pass by, first.
std::vector<TrackBirth::Meeting> TrackBirth::starts_with(const Sighting& sighting,
                                                         const StationErrors& errors) {
  constexpr std::size_t kEnough = 16;
  std::vector<std::pair<int, Meeting>> starts;
  for (const auto& [station, bearings] : pool_) {
    if (station == sighting.station) continue;
    const Sighting* frame = nearest(bearings, sighting, nullptr, errors);
    if (frame == nullptr) continue;
    for (auto it = bearings.rbegin(); it != bearings.rend(); ++it) {
      if (it->utime_us < frame->utime_us) break;
      const auto start = start_of(sighting, *it, errors);
      if (!start) continue;
      int support = 0;
      for (const auto& [third, others] : pool_) {
        if (third == station || third == sighting.station) continue;
        support += nearest(others, sighting, &*start, errors) != nullptr ? 1 : 0;
      }
      starts.emplace_back(support, *start);
      if (starts.size() >= kEnough) break;
    }
  }
  std::ranges::stable_sort(starts, std::greater<>(), [](const auto& s) { return s.first; });
  std::vector<Meeting> meetings;
  for (auto& [support, start] : starts) meetings.push_back(std::move(start));
  return meetings;
}

std::optional<Track> TrackBirth::add(const Sighting& sighting, StationErrors& errors,
                                     bool trusting) {
  store(sighting);
  failure_ = Solution::kTooFewRays;
  const std::vector<Meeting> starts = starts_with(sighting, errors);
  for (std::size_t i = 0; i < std::min(starts.size(), kMostStarts); ++i) {
    auto begun = try_start(sighting, starts[i], errors, trusting ? Needed::kTwoRays : Needed::kAll);
    if (!begun) continue;
    if (!trusting && is_outdone(*begun, sighting, errors)) continue;
    errors = std::move(begun->errors);
    if (!trusting) take(begun->track);
    return std::move(begun->track);
  }
  return std::nullopt;
}

// Does one of its two stations agree better with a third?
bool TrackBirth::is_outdone(const Begun& begun, const Sighting& newest,
                            const StationErrors& errors) {
  const auto& own = begun.track.hits;
  if (own.size() > 2) return false;
  for (const auto& [name, bearings] : pool_) {
    const Sighting& third = bearings.back();
    if (own.contains(name) || apart_s(third, newest) > config_.pair_s) continue;
    int tried = 0;
    for (const Meeting& start : starts_with(third, errors)) {
      if (!own.contains(start.second)) continue;
      const auto rival = try_start(third, start, errors, Needed::kHalf);
      if (rival && (rival->track.hits.size() > 2 || rival->misfit < begun.misfit)) {
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
  std::vector<const Sighting*> bearings;
};

std::vector<Frame> frames_backwards(const std::map<std::string, std::deque<Sighting>>& pool,
                                    std::int64_t oldest_us) {
  std::vector<Frame> frames;
  for (const auto& [station, bearings] : pool) {
    for (const Sighting& sighting : bearings) {
      if (sighting.utime_us < oldest_us) continue;
      const bool same = !frames.empty() && frames.back().utime_us == sighting.utime_us &&
                        frames.back().bearings.front()->station == station;
      if (!same) frames.push_back({sighting.utime_us, {}});
      frames.back().bearings.push_back(&sighting);
    }
  }
  std::ranges::stable_sort(frames, std::greater<>(), &Frame::utime_us);
  return frames;
}

struct Explained {
  int frames = 0;
  double misfit = 0.0;             // sum of the squared normalised residuals, the gate at most
  std::vector<Sighting> bearings;  // the latest first
};

// Runs the filter over the frames: each gives its nearest bearing, if that is in the gate.
std::map<std::string, Explained> explain(const std::vector<Frame>& frames, TrackFilter& filter,
                                         StationErrors& errors) {
  std::map<std::string, Explained> stations;
  for (const Frame& frame : frames) {
    const Sighting* best = nullptr;
    double least = filter.config().gate_nis;
    for (const Sighting* sighting : frame.bearings) {
      const double nis = filter.nis(*sighting, errors);
      if (nis >= least) continue;
      least = nis;
      best = sighting;
    }
    Explained& station = stations[frame.bearings.front()->station];
    ++station.frames;
    station.misfit += least;
    if (best == nullptr || filter.update(*best, errors) != BearingUse::kUsed) continue;
    station.bearings.push_back(*best);
  }
  return stations;
}

// What the stations that agree on a start have in common.
struct Agreement {
  int hits = 0, frames = 0;
  double misfit = 0.0;
  std::int64_t oldest_us = 0;
};

// Gives the track the bearings of those stations that agree on it.
Agreement agree(std::map<std::string, Explained>& stations, double least_share, Track& track) {
  Agreement sum{.oldest_us = track.born_us};
  for (auto& [name, station] : stations) {
    const int here = static_cast<int>(station.bearings.size());
    if (here == 0 || here < least_share * station.frames) continue;
    sum.hits += here;
    sum.frames += station.frames;
    sum.misfit += station.misfit;
    sum.oldest_us = std::min(sum.oldest_us, station.bearings.back().utime_us);
    track.hits[name] = here;
    std::ranges::reverse(station.bearings);
    track.bearings[name] = std::move(station.bearings);
  }
  return sum;
}

}  // namespace

std::optional<TrackBirth::Begun> TrackBirth::try_start(const Sighting& newest, const Meeting& start,
                                                       const StationErrors& errors, Needed needed) {
  std::int64_t now_us = newest.utime_us;
  for (const auto& [station, bearings] : pool_) {
    if (apart_s(bearings.back(), newest) <= config_.pair_s) {
      now_us = std::max(now_us, bearings.back().utime_us);
    }
  }
  auto frames = frames_backwards(pool_, now_us - static_cast<std::int64_t>(config_.pool_s * 1e6));
  // A start is vague: whoever is heard first, it goes to. So first the two that made it.
  std::stable_partition(frames.begin(), frames.end(), [&](const Frame& frame) {
    const std::string& station = frame.bearings.front()->station;
    return station == start.first || station == start.second;
  });
  FilterStart from{.p_ecef = start.p_ecef,
                   .position_sd_m = start.range_m / 2.0,
                   .velocity_sd_m_s = 2.0 * config_.rate_sd_rad_s * start.range_m};
  std::optional<Begun> begun;
  std::map<std::string, Explained> stations;
  // The second round is linearised where the first one has ended: what a clock's error does depends
  // on the velocity, and one taken for zero would make the clocks seem known.
  for (int round = 0; round < 2; ++round) {
    begun.emplace(Begun{Track(TrackFilter(filter_, now_us, from)), errors});
    stations = explain(frames, begun->track.filter, begun->errors);
    from.p_ecef = begun->track.filter.position();
    from.v_ecef = begun->track.filter.velocity();
    if (!from.p_ecef.allFinite() || !from.v_ecef.allFinite()) return std::nullopt;
  }
  begun->track.born_us = begun->track.located_us = now_us;
  const Agreement sum = agree(stations, config_.explained, begun->track);
  const std::size_t agreeing = begun->track.hits.size();
  failure_ = Solution::kRaysMiss;
  if (agreeing < 2) return std::nullopt;
  failure_ = Solution::kTooFewRays;
  const double long_s = config_.two_stations_s * (needed == Needed::kAll ? 1.0 : 0.5);
  const bool long_enough = agreeing > 2 || seconds(now_us - sum.oldest_us) >= long_s;
  const bool enough = sum.hits >= config_.least_bearings && long_enough;
  if (needed != Needed::kTwoRays && !enough) return std::nullopt;
  begun->misfit = sum.misfit / sum.frames;
  return begun;
}

void TrackBirth::take(const Track& track) {
  for (const auto& [station, bearings] : track.bearings) {
    auto& own = pool_[station];
    const auto& taken = bearings;  // clang 14 captures no structured binding
    std::erase_if(own, [&](const Sighting& s) {
      return std::ranges::any_of(taken, [&](const Sighting& t) {
        return t.utime_us == s.utime_us &&
               t.sight.direction.azimuth_rad == s.sight.direction.azimuth_rad &&
               t.sight.direction.elevation_rad == s.sight.direction.elevation_rad;
      });
    });
    if (own.empty()) pool_.erase(station);
  }
}

void TrackBirth::give(const Track& track, const StationErrors& errors) {
  for (auto it = pool_.begin(); it != pool_.end();) {
    std::erase_if(it->second, [&](const Sighting& sighting) {
      return track.filter.nis(sighting, errors) < filter_.robust_nis;
    });
    it = it->second.empty() ? pool_.erase(it) : std::next(it);
  }
}

}  // namespace ols
