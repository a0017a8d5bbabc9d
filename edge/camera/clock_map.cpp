#include "edge/camera/clock_map.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace ols::camera {
namespace {

constexpr double kHuber = 3.0;   // standard deviations; a latch within them has its full weight
constexpr double kFarOff = 6.0;  // standard deviations beyond its interval: the clock was stepped
constexpr double kLateArrival_s = 1.0;
constexpr int kLateArrivals = 3;

double middle(const LatchSample& s) { return 0.5 * (s.before_s + s.after_s); }
double half_width(const LatchSample& s) { return 0.5 * (s.after_s - s.before_s); }
double delta_s(std::int64_t later, std::int64_t earlier) {
  return 1e-9 * static_cast<double>(later - earlier);
}

}  // namespace

void ClockMap::clear() {
  latches_.clear();
  suspect_.reset();
  fit_ = {};
  arrivals_.clear();
  arrivals_off_ = 0;
}

double ClockMap::seconds(std::int64_t device_ns) const {
  return delta_s(device_ns, latches_.back().device_ns);
}

bool ClockMap::far_off(const LatchSample& sample) const {
  const auto expected = from_latches(sample.device_ns);
  if (!expected) return false;
  return std::abs(middle(sample) - expected->time_s) >
         half_width(sample) + kFarOff * expected->sd_s;
}

bool ClockMap::add_latch(const LatchSample& sample) {
  if (!(sample.after_s >= sample.before_s) || !std::isfinite(sample.before_s) ||
      !std::isfinite(sample.after_s))
    return false;
  const bool backwards = !latches_.empty() && sample.device_ns <= latches_.back().device_ns;
  if (backwards || far_off(sample)) {
    const auto earlier = std::exchange(suspect_, sample);
    if (!earlier || sample.device_ns <= earlier->device_ns) return true;
    ClockMap fresh(config_);
    fresh.add_latch(*earlier);
    if (fresh.far_off(sample)) return true;
    clear();
    latches_.push_back(*earlier);
  }
  suspect_.reset();
  latches_.push_back(sample);
  if (static_cast<int>(latches_.size()) > config_.window) latches_.pop_front();
  refit();
  return true;
}

// Weighted least squares of offset and rate with a prior on the rate; Huber weights against latches
// that a busy host has shifted within their interval.
void ClockMap::refit() {
  const double origin = middle(latches_.back());
  const auto variance = [&](const LatchSample& s) {
    const double wander = config_.rate_wander * seconds(s.device_ns);
    const double half = half_width(s);  // uniform in the interval
    return half * half / 3.0 + config_.device_sd_s * config_.device_sd_s + wander * wander;
  };
  Eigen::Vector2d x = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Identity();
  double half_square = 0.0;
  for (int iteration = 0; iteration < 4; ++iteration) {
    Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
    information(1, 1) = 1.0 / (config_.rate_sd * config_.rate_sd);
    Eigen::Vector2d right = Eigen::Vector2d::Zero();
    double weights = 0.0;
    half_square = 0.0;
    for (const LatchSample& s : latches_) {
      const double t = seconds(s.device_ns);
      const double y = middle(s) - origin - t;
      const double var = variance(s);
      double weight = 1.0 / var;
      if (iteration > 0) {
        const double residual = std::abs(y - x[0] - x[1] * t) / std::sqrt(var);
        if (residual > kHuber) weight *= kHuber / residual;
      }
      const Eigen::Vector2d row(1.0, t);
      information += weight * row * row.transpose();
      right += weight * y * row;
      weights += weight;
      half_square += weight * half_width(s) * half_width(s);
    }
    half_square /= weights;
    covariance = information.inverse();
    x = covariance * right;
  }
  fit_ = {.offset = x[0],
          .rate = x[1],
          .var_offset = covariance(0, 0),
          .var_rate = covariance(1, 1),
          .covariance = covariance(0, 1),
          // One direction may always take longer than the other: this does not average out.
          .systematic_sd_s = std::sqrt(half_square / 3.0)};
}

std::optional<MappedTime> ClockMap::from_latches(std::int64_t device_ns) const {
  if (latches_.empty()) return std::nullopt;
  const double t = seconds(device_ns);
  const double wander = config_.rate_wander * t;
  const double variance = fit_.var_offset + 2.0 * t * fit_.covariance + t * t * fit_.var_rate +
                          fit_.systematic_sd_s * fit_.systematic_sd_s +
                          config_.device_sd_s * config_.device_sd_s + wander * wander;
  return MappedTime{.time_s = middle(latches_.back()) + t + fit_.offset + fit_.rate * t,
                    .sd_s = std::sqrt(variance)};
}

void ClockMap::add_arrival(std::int64_t device_ns, double arrival_s) {
  if (const auto earliest = from_arrivals(device_ns, 0.0)) {
    // One arrival much later than the envelope is a busy host; several in a row are a clock that
    // was stepped back. A clock stepped forward forms a new envelope by itself.
    const bool late = arrival_s - earliest->time_s > kLateArrival_s;
    arrivals_off_ = late ? arrivals_off_ + 1 : 0;
    if (arrivals_off_ >= kLateArrivals) {
      arrivals_.clear();
      arrivals_off_ = 0;
    }
  }
  arrivals_.push_back({device_ns, arrival_s});
  while (arrival_s - arrivals_.front().arrival_s > config_.arrival_window_s) arrivals_.pop_front();
}

std::optional<MappedTime> ClockMap::from_arrivals(std::int64_t device_ns, double delay_s) const {
  if (arrivals_.empty()) return std::nullopt;
  double earliest = std::numeric_limits<double>::infinity();
  for (const Arrival& a : arrivals_)
    earliest = std::min(earliest, a.arrival_s + delta_s(device_ns, a.device_ns));
  return MappedTime{.time_s = earliest - delay_s,
                    .sd_s = config_.rate_sd * config_.arrival_window_s};
}

}  // namespace ols::camera
