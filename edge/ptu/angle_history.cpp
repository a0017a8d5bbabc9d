#include "edge/ptu/angle_history.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace ols {

namespace {

Eigen::Vector2d vector(const PanTilt& angles) { return {angles.pan_rad, angles.tilt_rad}; }
PanTilt pan_tilt(const Eigen::Vector2d& v) { return {v.x(), v.y()}; }

Eigen::Vector2d time_sd_s(const AngleSample& sample) {
  return {sample.time_sd_s, sample.tilt_time_sd_s.value_or(sample.time_sd_s)};
}

bool finite(const AngleSample& sample) {
  return std::isfinite(sample.time_s) && time_sd_s(sample).allFinite() &&
         vector(sample.angles).allFinite();
}

}  // namespace

bool AngleHistory::add(const AngleSample& sample) {
  if (!finite(sample)) return false;
  if (!samples_.empty() && sample.time_s <= samples_.back().time_s) return false;
  samples_.push_back(sample);
  while (samples_.front().time_s < sample.time_s - config_.span_s) samples_.pop_front();
  return true;
}

std::optional<AngleSample> AngleHistory::newest() const {
  return samples_.empty() ? std::nullopt : std::optional(samples_.back());
}

// Linear between (or beyond) two samples. The errors: half an encoder step either way and the
// sample's time error at the speed of travel, both carried by the weights of the two samples; and
// what the motion may have done besides going straight, |a| w (1 - w) T^2 / 2. The axes are read
// one after the other, so their time errors count as independent.
std::optional<AngleAt> AngleHistory::at(double time_s) const {
  if (samples_.size() < 2 || !(time_s >= samples_.front().time_s)) return std::nullopt;
  auto after =
      std::lower_bound(samples_.begin(), samples_.end(), time_s,
                       [](const AngleSample& sample, double time) { return sample.time_s < time; });
  const bool interpolated = after != samples_.end();
  if (!interpolated) after = std::prev(samples_.end());
  if (after == samples_.begin()) ++after;
  const AngleSample& a = *std::prev(after);
  const AngleSample& b = *after;
  const double gap_s = b.time_s - a.time_s;
  if (gap_s > config_.max_gap_s || time_s - b.time_s > config_.max_extrapolation_s) {
    return std::nullopt;
  }
  const double weight = (time_s - a.time_s) / gap_s;  // of b; more than 1 beyond it
  const Eigen::Vector2d rate = (vector(b.angles) - vector(a.angles)) / gap_s;
  const double step_variance = config_.step_rad * config_.step_rad / 12.0;
  const double wa2 = (1.0 - weight) * (1.0 - weight);
  const double wb2 = weight * weight;
  const Eigen::Array2d time_variance =
      wa2 * time_sd_s(a).array().square() + wb2 * time_sd_s(b).array().square();
  const double bend_rad =
      config_.acceleration_sd_rad_s2 * 0.5 * gap_s * gap_s * std::abs(weight * (1.0 - weight));
  AngleAt result;
  result.angles = pan_tilt(vector(a.angles) + weight * gap_s * rate);
  result.rate = pan_tilt(rate);
  const Eigen::Array2d variance =
      rate.array().square() * time_variance + step_variance * (wa2 + wb2) + bend_rad * bend_rad;
  result.covariance = variance.matrix().asDiagonal();
  result.interpolated = interpolated;
  return result;
}

}  // namespace ols
