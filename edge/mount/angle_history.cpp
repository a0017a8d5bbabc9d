#include "edge/mount/angle_history.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace ols::mount {

namespace {

bool finite(const PanTilt& p) { return std::isfinite(p.pan_rad) && std::isfinite(p.tilt_rad); }

bool finite(const AngleSample& s) {
  return std::isfinite(s.time_s) && std::isfinite(s.time_sd_s) &&
         std::isfinite(s.shared_time_sd_s) && std::isfinite(s.tilt_time_sd_s.value_or(0.0)) &&
         std::isfinite(s.tilt_delay_s) && finite(s.angles) && finite(s.doubt) &&
         finite(s.place_sd) && finite(s.acceleration) && finite(s.step_share);
}

double square(double x) { return x * x; }

const double kUniform = 1.0 / std::sqrt(12.0);  // 1-sigma of a uniform distribution, of its width

}  // namespace

AngleHistory::Knot AngleHistory::pan_knot(const AngleSample& s) {
  return {s.time_s,
          s.time_sd_s,
          s.shared_time_sd_s,
          s.angles.pan_rad,
          s.doubt.pan_rad,
          s.place_sd.pan_rad,
          s.acceleration.pan_rad,
          s.step_share.pan_rad,
          s.ordered_change ? std::optional(s.ordered_change->pan_rad) : std::nullopt};
}

AngleHistory::Knot AngleHistory::tilt_knot(const AngleSample& s) {
  return {s.time_s + s.tilt_delay_s,
          s.tilt_time_sd_s.value_or(s.time_sd_s),
          s.shared_time_sd_s,
          s.angles.tilt_rad,
          s.doubt.tilt_rad,
          s.place_sd.tilt_rad,
          s.acceleration.tilt_rad,
          s.step_share.tilt_rad,
          s.ordered_change ? std::optional(s.ordered_change->tilt_rad) : std::nullopt};
}

bool AngleHistory::add(const AngleSample& sample) {
  if (!finite(sample)) return false;
  if (!samples_.empty()) {
    const bool later = sample.time_s > samples_.back().time_s &&
                       tilt_knot(sample).time_s > tilt_knot(samples_.back()).time_s;
    if (!later) return false;
  }
  samples_.push_back(sample);
  while (samples_.front().time_s < sample.time_s - config_.span_s) samples_.pop_front();
  return true;
}

std::optional<AngleSample> AngleHistory::newest() const {
  return samples_.empty() ? std::nullopt : std::optional(samples_.back());
}

std::optional<AngleAt> AngleHistory::at(double time_s) const {
  const auto pan = axis_at(time_s, pan_knot);
  const auto tilt = axis_at(time_s, tilt_knot);
  if (!pan || !tilt) return std::nullopt;
  AngleAt result;
  result.angles = {pan->angle_rad, tilt->angle_rad};
  result.rate = {pan->rate_rad_s, tilt->rate_rad_s};
  // The axes are read one after the other: their errors are independent.
  result.covariance = Eigen::Vector2d(pan->variance_rad2, tilt->variance_rad2).asDiagonal();
  result.lasting_covariance = Eigen::Vector2d(pan->lasting_rad2, tilt->lasting_rad2).asDiagonal();
  result.interpolated = pan->interpolated && tilt->interpolated;
  return result;
}

// Linear between (or beyond) two samples. The errors: those of the two samples, by their weights;
// that of the time that they share; and that of an unknown acceleration, |a| w (1 - w) T^2 / 2.
// Beyond the newest sample, an acceleration not yet seen is at most what was ordered, if that is
// known.
std::optional<AngleHistory::AxisAt> AngleHistory::axis_at(double time_s, KnotOf knot) const {
  if (samples_.size() < 2 || !(time_s >= knot(samples_.front()).time_s)) return std::nullopt;
  const auto after = std::lower_bound(
      samples_.begin(), samples_.end(), time_s,
      [knot](const AngleSample& sample, double time) { return knot(sample).time_s < time; });
  const bool interpolated = after != samples_.end();
  const std::size_t index = interpolated
                                ? static_cast<std::size_t>(std::distance(samples_.begin(), after))
                                : samples_.size() - 1;
  const std::size_t right = std::max<std::size_t>(index, 1);
  const Knot a = knot(samples_[right - 1]);
  const Knot b = knot(samples_[right]);
  const double gap_s = b.time_s - a.time_s;
  const double beyond_s = std::max(0.0, time_s - b.time_s);
  if (gap_s > config_.max_gap_s || beyond_s > config_.max_extrapolation_s) return std::nullopt;
  const double weight = (time_s - a.time_s) / gap_s;  // of b; more than 1 beyond it
  const double rate = (b.angle_rad - a.angle_rad) / gap_s;
  const double lever_s2 = 0.5 * gap_s * gap_s * std::abs(weight * (1.0 - weight));
  double unseen2 = square(config_.acceleration_sd_rad_s2);
  if (!interpolated && b.ordered_change_rad_s)
    unseen2 = std::min(unseen2, square(*b.ordered_change_rad_s / gap_s));
  const double bend = square(lever_s2) * (unseen2 + bend2(right, knot));
  const double begun = begun_variance(b, beyond_s);
  const double shared = square(rate * b.shared_time_sd_s);
  return AxisAt{a.angle_rad + weight * gap_s * rate, rate,
                square(1.0 - weight) * knot_variance(a, rate) +
                    square(weight) * knot_variance(b, rate) + shared + bend + begun,
                std::max(square(a.place_sd_rad), square(b.place_sd_rad)), interpolated};
}

// The unit may have begun to accelerate after the newest sample: with half of the maximum as
// standard deviation; or, if the ordered change of rate is known, by that change at an unknown
// instant.
double AngleHistory::begun_variance(const Knot& newest, double beyond_s) const {
  if (!newest.ordered_change_rad_s)
    return square(0.5 * config_.acceleration_max_rad_s2 * 0.5 * square(beyond_s));
  return square(kUniform * *newest.ordered_change_rad_s * beyond_s);
}

double AngleHistory::knot_variance(const Knot& knot, double rate_rad_s) const {
  return square(rate_rad_s * knot.time_sd_s) + knot.step_share * square(config_.step_rad) / 12.0 +
         square(knot.doubt_rad) + square(knot.place_sd_rad);
}

double AngleHistory::bend2(std::size_t b, KnotOf knot) const {
  const double before = b >= 2 ? bend2_at(b - 1, knot) : 0.0;
  const double behind = b + 1 < samples_.size() ? bend2_at(b, knot) : 0.0;
  return std::max({before, behind, square(knot(samples_[b]).acceleration_rad_s2)});
}

// The squared acceleration that three samples in a row show beyond their noise.
double AngleHistory::bend2_at(std::size_t middle, KnotOf knot) const {
  const Knot x = knot(samples_[middle - 1]);
  const Knot y = knot(samples_[middle]);
  const Knot z = knot(samples_[middle + 1]);
  const double first_s = y.time_s - x.time_s;
  const double second_s = z.time_s - y.time_s;
  const double first = (y.angle_rad - x.angle_rad) / first_s;
  const double second = (z.angle_rad - y.angle_rad) / second_s;
  const double noise =
      knot_variance(x, first) / square(first_s) +
      knot_variance(y, 0.5 * (first + second)) * square(1.0 / first_s + 1.0 / second_s) +
      knot_variance(z, second) / square(second_s);
  constexpr double kCertainly = 2.0;  // standard deviations squared that noise alone may show
  const double shown = square(second - first) - kCertainly * noise;
  return std::max(0.0, shown) / square(0.5 * (first_s + second_s));
}

}  // namespace ols::mount
