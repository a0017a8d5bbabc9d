#include "edge/camera/rtsp/arrival_line.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ols::camera {
namespace {

constexpr double kSpan_s = 2.0;
constexpr std::size_t kSpans = 150;     // five minutes
constexpr std::size_t kLeastSpans = 5;  // for a measured rate, the open one included
constexpr double kGap_s = 30.0;         // without pictures: nothing is known of the clock any more

constexpr double kPrior_s = 0.010;        // the scatter, while there are too few spans to show it
constexpr std::size_t kScatterSpans = 8;  // show it: fewer would often show too little by chance
constexpr double kLeastScatter_s = 1e-5;  // of stamps that count 90 000 a second

constexpr double kOscillator = 1e-4;  // 1-sigma of an honest rate error
constexpr double kFarOffRate = 5e-3;  // no oscillator: the stamps lie
constexpr double kFarOffAtFirst = 0.02;
// To accept a rate that is far off: two spans fit any rate.
constexpr std::size_t kFewestSpans = 3;

constexpr std::size_t kStepSpans = 3;  // in a row on one side of the line: the clock was stepped
constexpr double kLineStep_s = 0.05;
constexpr double kStepSigmas = 6.0;
constexpr double kHuber = 3.0;

}  // namespace

double ArrivalLine::seconds(std::int64_t device_ns) const {
  return 1e-9 * static_cast<double>(device_ns - origin_ns_);
}

double ArrivalLine::residual_s(const Least& least) const {
  return least.arrival_s - offset_s_ - rate_ * (least.device_s - reference_s_);
}

double ArrivalLine::step_limit_s() const { return std::max(kLineStep_s, kStepSigmas * sd_s_); }

bool ArrivalLine::knows_rate() const { return least_.size() >= kLeastSpans; }

bool ArrivalLine::shows_scatter() const { return least_.size() > kScatterSpans; }

void ArrivalLine::add(std::int64_t device_ns, double arrival_s) {
  if (!least_.empty() && arrival_s - least_.back().arrival_s > kGap_s) clear();
  // Nothing makes a picture early: its stamp was set forward.
  if (knows_rate() && residual_s({seconds(device_ns), arrival_s}) < -step_limit_s()) clear();
  if (least_.empty()) origin_ns_ = device_ns;
  const Least picture{seconds(device_ns), arrival_s};
  const bool begins = least_.empty() || arrival_s - span_from_s_ >= kSpan_s;
  if (begins) {
    forget_what_came_before_a_step();
    least_.push_back(picture);
    if (least_.size() > kSpans) least_.pop_front();
    span_from_s_ = arrival_s;
  } else if (residual_s(picture) < residual_s(least_.back())) {
    least_.back() = picture;
  } else if (knows_rate()) {
    return;  // the line stays
  }
  fit();
}

// Compares the newest spans with a line through the older ones. fit() leaves the last of these out,
// and a rate that is far off takes kFewestSpans: there must be one more.
void ArrivalLine::forget_what_came_before_a_step() {
  if (least_.size() <= kStepSpans + kFewestSpans) return;
  ArrivalLine before = *this;
  before.least_.erase(before.least_.end() - kStepSpans, before.least_.end());
  before.fit();
  const double limit_s = before.step_limit_s();
  const auto from = least_.end() - kStepSpans;
  const auto beyond = [&](double sign) {
    return std::all_of(from, least_.end(), [&](const Least& least) {
      return sign * before.residual_s(least) > limit_s;
    });
  };
  if (beyond(1.0) || beyond(-1.0)) least_.erase(least_.begin(), from);
}

// An honest oscillator bounds the rate, as firmly as the scatter demands. A rate that is far off is
// fitted freely, but only if this explains the arrivals clearly better: on a busy host, even the
// least delayed pictures of a few spans are late by very different times.
void ArrivalLine::fit() {
  constexpr double kClearly = 4.0;
  const std::size_t used = least_.size() - (least_.size() > 1 ? 1 : 0);
  const Least &oldest = least_.front(), &last = least_[used - 1];
  const double span_s = last.device_s - oldest.device_s;
  const double slope = span_s > 0.0 ? (last.arrival_s - oldest.arrival_s) / span_s : 1.0;
  Fitted fitted = fitted_from(1.0, false, used);
  if (used >= kFewestSpans &&
      std::abs(slope - 1.0) > (knows_rate() ? kFarOffRate : kFarOffAtFirst)) {
    const Fitted free = fitted_from(slope, true, used);
    if (free.sd_s < fitted.sd_s / kClearly) fitted = free;
  }
  reference_s_ = least_.back().device_s;
  offset_s_ = fitted.offset_s;
  rate_ = fitted.rate;
  sd_s_ = fitted.sd_s;
}

// Least squares, with Huber weights against spans in which every picture was late. The open span
// may not have had its least delayed picture yet: it counts only while there is no other.
ArrivalLine::Fitted ArrivalLine::fitted_from(double start_rate, bool free, std::size_t used) const {
  const Least& newest = least_.back();
  std::array<double, 2> x{newest.arrival_s, start_rate};
  double scale_s = kPrior_s;
  for (int turn = 0; turn < 4; ++turn) {
    const double rate_information = free ? 0.0 : std::pow(scale_s / kOscillator, 2);
    double n = 0, t = 0, tt = rate_information, y = 0, ty = 0, square = 0;
    for (std::size_t i = 0; i < used; ++i) {
      const Least& least = least_[i];
      const double time_s = least.device_s - newest.device_s;
      const double value_s = least.arrival_s - newest.arrival_s - start_rate * time_s;
      const double residual = least.arrival_s - x[0] - x[1] * time_s;
      const bool late = turn > 0 && residual > kHuber * scale_s;
      const double weight = late ? kHuber * scale_s / residual : 1.0;
      n += weight;
      t += weight * time_s;
      tt += weight * time_s * time_s;
      y += weight * value_s;
      ty += weight * time_s * value_s;
      if (turn > 0) square += weight * residual * residual;
    }
    if (turn > 0) {
      scale_s = used < kScatterSpans ? std::hypot(kPrior_s, std::sqrt(square / n))
                                     : std::sqrt(square / std::max(n - 2.0, 1.0));
      scale_s = std::max(scale_s, kLeastScatter_s);
    }
    const double determinant = n * tt - t * t;
    const bool solvable = determinant > 1e-9 * n * tt && least_.size() >= 2;
    x[0] = newest.arrival_s + (solvable ? (tt * y - t * ty) / determinant : y / n);
    x[1] = start_rate + (solvable ? (n * ty - t * y) / determinant : 0.0);
  }
  return {x[0], x[1], scale_s};
}

std::optional<MappedTime> ArrivalLine::at(std::int64_t device_ns) const {
  if (least_.empty()) return std::nullopt;
  return MappedTime{.time_s = offset_s_ + rate_ * (seconds(device_ns) - reference_s_),
                    .sd_s = sd_s_};
}

}  // namespace ols::camera
