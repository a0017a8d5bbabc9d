// Where rays meet: the starts that a new track may be tried from.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "central/measurement/time_span.h"
#include "central/tracking/track_birth.h"
#include "geometry/angles.h"
#include "geometry/wgs84.h"

namespace ols {
namespace {

double apart_s(const Sighting& a, const Sighting& b) {
  return std::abs(seconds(a.utime_us - b.utime_us));
}

}  // namespace

// How far a target may have gone on, generously.
double TrackBirth::moved_rad(double dt_s) const {
  return config_.miss_sigma * config_.rate_sd_rad_s * std::min(1.0, dt_s);
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

// Where two rays pass each other, if they do so in front of both cameras and near enough. What the
// looks rule out is not asked for exactly: that costs ten times as much.
std::optional<TrackBirth::Meeting> TrackBirth::start_of(const Sighting& a, const Look& look,
                                                        const Sighting& b, const Look& other,
                                                        const StationErrors& errors) {
  const auto none = [this](Solution why) {
    failure_ = why;
    return std::nullopt;
  };
  const Eigen::Vector3d &u = look.direction_ecef, &v = other.direction_ecef;
  const Eigen::Vector3d base = other.origin_ecef - look.origin_ecef;
  constexpr double kOnePlaceM = 0.01;
  const double along = u.dot(v), across = u.cross(v).squaredNorm();
  if (base.norm() < kOnePlaceM) return none(Solution::kParallelRays);
  if (across < std::pow((look.spread_rad + other.spread_rad) / 2.0, 2)) {
    const double noise_rad = gate_rad(a, 0.0, 1e9, errors) + gate_rad(b, 0.0, 1e9, errors);
    if (across < noise_rad * noise_rad / 4.0) return none(Solution::kParallelRays);
  }
  const double s = (base.dot(u) - along * base.dot(v)) / across;
  const double t = (along * base.dot(u) - base.dot(v)) / across;
  if (s <= 0.0 || t <= 0.0) return none(Solution::kBehindCamera);
  if (std::min(s, t) > filter_.max_range_m) return none(Solution::kTooFar);
  const Eigen::Vector3d on_a = look.origin_ecef + s * u, on_b = other.origin_ecef + t * v;
  const double dt_s = apart_s(a, b), off_m = (on_a - on_b).norm();
  if (off_m > s * (look.spread_rad + moved_rad(dt_s + look.clock_sd_s)) +
                  t * (other.spread_rad + moved_rad(other.clock_sd_s))) {
    return none(Solution::kRaysMiss);
  }
  const double miss_m = s * gate_rad(a, dt_s, s, errors) + t * gate_rad(b, 0.0, t, errors);
  if (off_m > miss_m) return none(Solution::kRaysMiss);
  return Meeting{(on_a + on_b) / 2.0, std::min(s, t), a.station, b.station, off_m / miss_m};
}

// Of a station's bearings near in time to another one, the one that is nearest to the start; the
// latest where there is no start yet. -1: none.
std::ptrdiff_t TrackBirth::nearest(const BearingPool::Station& own, const Sighting& to,
                                   const Meeting* start, const StationErrors& errors) const {
  std::ptrdiff_t best = -1;
  double least = 1.0;
  for (auto i = std::ssize(own.looks) - 1; i >= 0; --i) {
    const Look& look = own.looks[static_cast<std::size_t>(i)];
    const double dt_s = std::abs(seconds(look.utime_us - to.utime_us));
    if (dt_s > config_.pair_s && look.utime_us < to.utime_us) break;
    if (dt_s > config_.pair_s) continue;
    if (start == nullptr) return i;
    if (!look.is_near(start->p_ecef, moved_rad(dt_s + look.clock_sd_s))) continue;
    const Sighting& sighting = own.bearings[static_cast<std::size_t>(i)];
    const double off = angle_between(look.direction_ecef, start->p_ecef - look.origin_ecef) /
                       gate_rad(sighting, dt_s, start->range_m, errors);
    if (off >= least) continue;
    least = off;
    best = i;
  }
  return best;
}

// Where the ray meets those of other stations; where more of the others pass by, first.
std::vector<TrackBirth::Meeting> TrackBirth::starts_with(const Sighting& sighting,
                                                         const StationErrors& errors) {
  constexpr std::size_t kEnough = 16;
  const Look look = look_of(sighting, R_ecef_enu(sighting.sight.origin_ecef));
  std::vector<Meeting> starts;
  for (const auto& [station, own] : pool_.stations()) {
    if (station == sighting.station) continue;
    const std::ptrdiff_t latest = nearest(own, sighting, nullptr, errors);
    for (auto i = latest; i >= 0; --i) {
      const auto at = static_cast<std::size_t>(i);
      if (own.looks[at].utime_us < own.looks[static_cast<std::size_t>(latest)].utime_us) break;
      auto start = start_of(sighting, look, own.bearings[at], own.looks[at], errors);
      if (start) starts.push_back(std::move(*start));
    }
  }
  std::ranges::stable_sort(starts, {}, &Meeting::miss);
  if (starts.size() > kEnough) starts.erase(starts.begin() + kEnough, starts.end());
  for (Meeting& start : starts) {
    for (const auto& [third, own] : pool_.stations()) {
      if (third == start.first || third == start.second) continue;
      start.support += nearest(own, sighting, &start, errors) >= 0 ? 1 : 0;
    }
  }
  std::ranges::stable_sort(starts, std::greater<>(), &Meeting::support);
  return starts;
}

}  // namespace ols
