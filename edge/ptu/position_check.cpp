#include "edge/ptu/position_check.h"

#include <algorithm>
#include <cmath>

namespace ols::ptu {

namespace {

constexpr double kMargin = 1.2;        // on the speed and acceleration that a unit states
constexpr double kSlack_counts = 2.0;  // roundings
constexpr double kLate_s = 0.03;
constexpr double kStale_s = 0.3;           // an older rate is not used
constexpr double kMinTimeSd_s = 2e-4;      // scheduling of this host
constexpr double kStanding_counts_s = 20;  // slower than this is standing
constexpr double kUsual = 1.5;  // disagreement, in standard deviations, that noise explains

double square(double x) { return x * x; }

}  // namespace

PositionCheck::Merged PositionCheck::middle(const PtuReadings& r) {
  Merged mean;
  mean.time_s = 0.5 * (r[0].time_s + r[1].time_s);
  mean.half_s = 0.5 * (r[0].half_s + r[1].half_s);
  mean.counts = 0.5 * (static_cast<double>(r[0].counts) + r[1].counts);
  return mean;
}

// Within the unit's maximum speed and, if its rate is known, within its acceleration from the
// position that this rate predicts; both with a margin for the uncertain instants.
bool PositionCheck::reachable(const Axis& axis, const Merged& now) {
  const double dt_s = now.time_s - axis.last->time_s;
  if (!(dt_s > 0.0)) return false;
  const double doubt_s = now.half_s + axis.last->half_s;
  const double way = now.counts - axis.last->counts;
  const double fastest = kMargin * axis.facts.upper_speed;
  if (std::abs(way) > fastest * (dt_s + doubt_s) + kSlack_counts) return false;
  if (!axis.rate_known) return true;
  const double surprise = std::abs(way - axis.rate_counts_s * dt_s);
  const double accelerated = kMargin * axis.facts.acceleration * dt_s * (dt_s + axis.gap_s);
  const double noise = 10.0 * kSlack_counts + 2.0 * axis.last->doubt_counts;
  return surprise <= accelerated + 2.0 * std::abs(axis.rate_counts_s) * doubt_s + noise;
}

// The mean of both readings, weighted by the accuracy of their instants. Disagreement beyond kUsual
// goes into doubt_counts: if one reading is wrong by g, the mean is wrong by its weight times g,
// and the disagreement shows g minus its effect on the rate.
std::optional<PositionCheck::Merged> PositionCheck::merged(const Axis& axis, const PtuReadings& r,
                                                           double commanded_rad_s2) {
  const Merged mean = middle(r);
  const double dt_s = mean.time_s - axis.last->time_s;
  const double rate = (mean.counts - axis.last->counts) / dt_s;
  const double apart_s = r[1].time_s - r[0].time_s;
  const double variance0 = square(rate * r[0].time_sd_s) + 1.0 / 12.0;
  const double variance1 = square(rate * r[1].time_sd_s) + 1.0 / 12.0;
  const double spread = std::sqrt(variance0 + variance1);
  const double odd = std::abs(static_cast<double>(r[1].counts) - r[0].counts - rate * apart_s);
  const double accelerated = kMargin * axis.facts.acceleration * apart_s * dt_s;
  const double possible = 2.0 * std::abs(rate) * (r[0].half_s + r[1].half_s) + accelerated +
                          axis.last->doubt_counts + kSlack_counts;
  if (!(odd <= possible)) return std::nullopt;
  const double weight1 = variance0 / (variance0 + variance1);
  const double weight0 = 1.0 - weight1;
  Merged result;
  result.time_s = weight0 * r[0].time_s + weight1 * r[1].time_s;
  result.half_s = weight0 * r[0].half_s + weight1 * r[1].half_s;
  const double sd0_s = weight0 * r[0].time_sd_s;
  const double sd1_s = weight1 * r[1].time_sd_s;
  result.time_sd_s = std::max(kMinTimeSd_s, std::sqrt(square(sd0_s) + square(sd1_s) +
                                                      2.0 * axis.correlation * sd0_s * sd1_s));
  result.counts = weight0 * r[0].counts + weight1 * r[1].counts;
  // The rounding errors of different counts are independent.
  if (std::abs(r[1].counts - r[0].counts) > 1) {
    result.step_share = square(weight0) + square(weight1);
  }
  const double heavier = std::max(weight0, weight1);
  const double shown = std::max(0.3, 1.0 - heavier * apart_s / dt_s);
  const double wrong = std::max(0.0, odd - kUsual * spread) * heavier / (kUsual * shown);
  // Under acceleration the mean of two positions is not on the path.
  const double bent =
      0.5 * weight0 * weight1 * apart_s * apart_s * commanded_rad_s2 / axis.facts.resolution_rad;
  result.doubt_counts = std::hypot(wrong, bent);
  return result;
}

void PositionCheck::remember(Axis& axis, const Merged& now) {
  axis.rate_known = axis.last && now.time_s - axis.last->time_s < kStale_s;
  axis.gap_s = axis.rate_known ? now.time_s - axis.last->time_s : 0.0;
  axis.rate_counts_s = axis.rate_known ? (now.counts - axis.last->counts) / axis.gap_s : 0.0;
  axis.last = now;
}

PositionCheck::Verdict PositionCheck::take(const PtuReadings& pan, const PtuReadings& tilt,
                                           const PanTilt& commanded_rad_s2) {
  for (const PtuReading& reading : {pan[0], pan[1], tilt[0], tilt[1]}) {
    if (!(reading.half_s <= kLate_s)) return Verdict::kLate;
  }
  const Merged pan_mean = middle(pan);
  const Merged tilt_mean = middle(tilt);
  if (!pan_.last || !tilt_.last) {
    remember(pan_, pan_mean);
    remember(tilt_, tilt_mean);
    return Verdict::kFirst;
  }
  if (!reachable(pan_, pan_mean) || !reachable(tilt_, tilt_mean)) {
    pan_.rate_known = tilt_.rate_known = false;  // it may be the last one that was wrong
    return Verdict::kRefused;
  }
  const bool stale = pan_mean.time_s - pan_.last->time_s > kStale_s;
  const auto p = merged(pan_, pan, commanded_rad_s2.pan_rad);
  const auto t = merged(tilt_, tilt, commanded_rad_s2.tilt_rad);
  if (!p || !t) {
    pan_.rate_known = tilt_.rate_known = false;
    return Verdict::kRefused;
  }
  remember(pan_, *p);
  remember(tilt_, *t);
  if (stale) return Verdict::kFirst;
  sample_ = {};
  sample_.time_s = p->time_s;
  sample_.time_sd_s = p->time_sd_s;
  sample_.angles = {p->counts * pan_.facts.resolution_rad, t->counts * tilt_.facts.resolution_rad};
  sample_.tilt_time_sd_s = t->time_sd_s;
  sample_.tilt_delay_s = t->time_s - p->time_s;
  sample_.step_share = {p->step_share, t->step_share};
  sample_.acceleration = commanded_rad_s2;
  sample_.doubt = {p->doubt_counts * pan_.facts.resolution_rad,
                   t->doubt_counts * tilt_.facts.resolution_rad};
  return Verdict::kBelieved;
}

PanTilt PositionCheck::rate_rad_s() const {
  return {pan_.rate_counts_s * pan_.facts.resolution_rad,
          tilt_.rate_counts_s * tilt_.facts.resolution_rad};
}

bool PositionCheck::standing() const {
  return pan_.rate_known && tilt_.rate_known && std::abs(pan_.rate_counts_s) < kStanding_counts_s &&
         std::abs(tilt_.rate_counts_s) < kStanding_counts_s;
}

}  // namespace ols::ptu
