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
  if ((on_a - on_b).norm() > miss_m) return std::nullopt;
  return Meeting{(on_a + on_b) / 2.0, std::min(s, t)};
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

std::optional<Track> TrackBirth::add(const Sighting& sighting, StationErrors& errors,
                                     bool trusting) {
  store(sighting);
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
      if (starts.size() >= 16) break;
    }
  }
  std::ranges::stable_sort(starts, std::greater<>(), [](const auto& s) { return s.first; });
  for (std::size_t i = 0; i < std::min(starts.size(), kMostStarts); ++i) {
    if (auto track = try_start(sighting, starts[i].second, errors, trusting)) {
      take(*track);
      return track;
    }
  }
  return std::nullopt;
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
  std::int64_t oldest_us = 0;
  std::vector<Sighting> bearings;
};

// Runs the filter backwards over the frames: each gives its nearest bearing, if that is in the
// gate.
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
    if (best == nullptr || filter.update(*best, errors) != BearingUse::kUsed) continue;
    station.bearings.push_back(*best);
    station.oldest_us = frame.utime_us;
  }
  return stations;
}

}  // namespace

std::optional<Track> TrackBirth::try_start(const Sighting& newest, const Meeting& start,
                                           StationErrors& errors, bool trusting) const {
  std::int64_t now_us = newest.utime_us;
  for (const auto& [station, bearings] : pool_) {
    if (apart_s(bearings.back(), newest) <= config_.pair_s) {
      now_us = std::max(now_us, bearings.back().utime_us);
    }
  }
  const auto frames =
      frames_backwards(pool_, now_us - static_cast<std::int64_t>(config_.pool_s * 1e6));
  FilterStart from{.p_ecef = start.p_ecef,
                   .position_sd_m = start.range_m / 2.0,
                   .velocity_sd_m_s = 2.0 * config_.rate_sd_rad_s * start.range_m};
  std::optional<Track> track;
  std::map<std::string, Explained> stations;
  // The second round is linearised where the first one has ended: what a clock's error does depends
  // on the velocity, and one taken for zero would make the clocks seem known.
  for (int round = 0; round < 2; ++round) {
    track.emplace(TrackFilter(filter_, now_us, from));
    stations = explain(frames, track->filter, errors);
    from.p_ecef = track->filter.position();
    from.v_ecef = track->filter.velocity();
    if (!from.p_ecef.allFinite() || !from.v_ecef.allFinite()) return std::nullopt;
  }
  int agreeing = 0, hits = 0;
  std::int64_t oldest_us = now_us;
  for (auto& [name, station] : stations) {
    const int here = static_cast<int>(station.bearings.size());
    if (here == 0 || here < config_.explained * station.frames) continue;
    ++agreeing;
    hits += here;
    oldest_us = std::min(oldest_us, station.oldest_us);
    track->hits[name] = here;
    std::ranges::reverse(station.bearings);
    track->bearings[name] = station.bearings;
  }
  const bool long_enough = agreeing > 2 || seconds(now_us - oldest_us) >= config_.two_stations_s;
  const bool enough = trusting || (hits >= config_.least_bearings && long_enough);
  if (agreeing < 2 || !enough) return std::nullopt;
  track->born_us = now_us;
  track->located_us = now_us;
  return track;
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
