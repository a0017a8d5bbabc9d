#include "central/tracking/clutter.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <vector>

#include "central/measurement/time_span.h"

namespace ols::fusion {
namespace {

constexpr double kMemoryS = 120.0;  // clutter changes with wind and light
constexpr double kEndedS = 1.0;     // a tracklet unseen for this long has ended
constexpr double kOldS = 5.0;       // another station would have seen it by now
constexpr std::size_t kMost = 512;

}  // namespace

void Clutter::note(const BearingMeasurement& measurement, bool is_undecided) {
  Station& own = stations_[measurement.station];
  const std::int64_t now_us = measurement.utime_us;
  if (own.since_us == 0) own.since_us = now_us;
  own.now_us = std::max(own.now_us, now_us);
  const LineOfSight& sight = measurement.sight;
  own.variance = 0.5 * (sight.covariance_white.trace() + sight.covariance_systematic.trace());
  std::erase_if(own.open, [&](const auto& entry) {
    const bool is_over = seconds(own.now_us - entry.second.last_us) > kEndedS;
    if (is_over) own.ended.push_back(entry.second);
    return is_over;
  });
  while (!own.ended.empty() &&
         (own.ended.size() > kMost || seconds(own.now_us - own.ended.front().last_us) > kMemoryS))
    own.ended.pop_front();
  Tracklet& tracklet = own.open[measurement.track_id];
  if (tracklet.first_us == 0) tracklet.first_us = now_us;
  tracklet.last_us = std::max(tracklet.last_us, now_us);
  tracklet.elevation_rad = measurement.sight.direction.elevation_rad;
  if (measurement.sighted.has_rate()) tracklet.rate_rad_s = measurement.sighted.rate_rad_s;
  tracklet.is_undecided = is_undecided;
}

void Clutter::claimed(const BearingMeasurement& measurement) {
  const auto own = stations_.find(measurement.station);
  if (own != stations_.end()) own->second.open.erase(measurement.track_id);
}

// An open tracklet may still prove to be a target's, and does not count, unless it is old and
// nothing else fits it.
Clutter::Density Clutter::density_of(const Station& station) {
  std::vector<Tracklet> all(station.ended.begin(), station.ended.end());
  for (const auto& [id, tracklet] : station.open) {
    const bool is_old = seconds(tracklet.last_us - tracklet.first_us) > kOldS;
    if (is_old && !tracklet.is_undecided) all.push_back(tracklet);
  }
  if (all.empty()) return {};
  const auto n = static_cast<double>(all.size());
  const std::int64_t first_us = std::ranges::min(all, {}, &Tracklet::first_us).first_us;
  const double watched_s =
      std::max(kEndedS, seconds(station.now_us - std::max(station.since_us, first_us)));
  double life_s = 0.0, mean_rad = 0.0, squares = 0.0, rate = 0.0;
  for (const Tracklet& t : all) {
    life_s += seconds(t.last_us - t.first_us) / n;
    mean_rad += t.elevation_rad / n;
    squares += t.elevation_rad * t.elevation_rad / n;
    rate += t.rate_rad_s.squaredNorm() / (2.0 * n);
  }
  const double variance = std::max(0.0, squares - mean_rad * mean_rad);
  return {.new_per_s = n / watched_s,
          .life_s = life_s,
          .present = n * life_s / watched_s,
          .height_rad = std::sqrt(12.0 * variance),
          .rate_variance = rate};
}

// A pair begins when one tracklet appears while the other is there. It agrees if their lines of
// sight meet within the gate, and stay in it for `agreed_s` while both live.
double Clutter::pairs_a_day(const std::string& a, const std::string& b, double agreed_s) const {
  constexpr double kDayS = 86'400.0, kGate = 5.0;  // sigmas
  const auto one = stations_.find(a), other = stations_.find(b);
  if (one == stations_.end() || other == stations_.end()) return 0.0;
  const Density da = density_of(one->second), db = density_of(other->second);
  if (da.life_s == 0.0 || db.life_s == 0.0) return 0.0;
  const double began = kDayS * (da.new_per_s * db.present + db.new_per_s * da.present);
  const double gate_rad = 2.0 * kGate * std::sqrt(one->second.variance + other->second.variance);
  const double height_rad = std::max({da.height_rad, db.height_rad, gate_rad});
  const double drift_rad_s = 2.0 * gate_rad / agreed_s;
  const double spread_rad_s =
      std::sqrt(2.0 * std::numbers::pi * (da.rate_variance + db.rate_variance));
  const double stay = drift_rad_s / std::max(drift_rad_s, spread_rad_s);
  const double live = std::exp(-agreed_s * (1.0 / da.life_s + 1.0 / db.life_s));
  return began * gate_rad / height_rad * stay * live;
}

double Clutter::published_a_day(double agreed_s, double most_of_a_pair) const {
  double sum = 0.0;
  for (auto a = stations_.begin(); a != stations_.end(); ++a) {
    for (auto b = std::next(a); b != stations_.end(); ++b) {
      sum += std::min(pairs_a_day(a->first, b->first, agreed_s), most_of_a_pair);
    }
  }
  return sum;
}

int Clutter::pairs_of_stations() const {
  const int n = static_cast<int>(stations_.size());
  return std::max(1, n * (n - 1) / 2);
}

}  // namespace ols::fusion
