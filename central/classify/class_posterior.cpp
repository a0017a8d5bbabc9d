#include "central/classify/class_posterior.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <string_view>

#include "central/classify/class_table.h"

namespace ols::fusion {
namespace {

// Of fewer outlines, a bird's are alike by chance more often than the table's densities say. Within
// less time, the outline of a bird with 2 wing beats a second need not change.
constexpr std::size_t kLeastOutlines = 5;
constexpr double kLeastSpan_s = 0.5;
constexpr std::size_t kFlicker = 4;  // its place among the features
constexpr int kKinds = static_cast<int>(std::size(kClassTable));
constexpr const Kind& kAnything = kClassTable[kKinds - 1];
static_assert(std::string_view(kAnything.name) == "anything");

double log_sum(const double* values, int count) {
  const double most = *std::max_element(values, values + count);
  double sum = 0.0;
  for (int i = 0; i < count; ++i) sum += std::exp(values[i] - most);
  return most + std::log(sum);
}

double log_density(const KindMode& mode, const Features& seen) {
  double log = std::log(mode.share);
  for (int i = 0; i < kFeatures; ++i) {
    if (seen[i].sd <= 0.0) continue;
    const double variance = mode.sd[i] * mode.sd[i] + seen[i].sd * seen[i].sd;
    const double off = seen[i].value - mode.mean[i];
    log -= 0.5 * (off * off / variance + std::log(2.0 * std::numbers::pi * variance));
  }
  return log;
}

double log_density(const Kind& kind, const Features& seen) {
  std::array<double, kModes> logs{};
  std::ranges::transform(kind.modes, logs.begin(),
                         [&](const KindMode& mode) { return log_density(mode, seen); });
  return log_sum(logs.data(), kModes);
}

// One look in a hundred may be an outlier: for example, an outline that has merged with a cloud.
double log_likelihood(const Kind& kind, const Features& seen) {
  constexpr double kStray = 0.01;
  const std::array<double, 2> logs{std::log(1.0 - kStray) + log_density(kind, seen),
                                   std::log(kStray) + log_density(kAnything, seen)};
  return log_sum(logs.data(), 2);
}

// Only the sizes with a noise. Those without were measured in another way.
StationSizes outlines_of(const StationSizes& sizes) {
  StationSizes outlines;
  std::ranges::copy_if(sizes, std::back_inserter(outlines),
                       [](const SeenSize& one) { return one.noise_m > 0.0; });
  return outlines;
}

bool show_flicker(const StationSizes& outlines) {
  return outlines.size() >= kLeastOutlines &&
         outlines.back().time_s - outlines.front().time_s >= kLeastSpan_s;
}

// The relative variance that noise causes in outlines; the same for both sides.
double noise_of(const StationSizes& outlines) {
  double noise = 0.0;
  for (const SeenSize& one : outlines) noise += std::pow(one.noise_m / one.value_m, 2);
  return noise / static_cast<double>(outlines.size());
}

// Relative variance of one side of the outlines, minus that of its noise.
Measured flicker_of(const StationSizes& outlines, double SeenSize::*side) {
  const auto count = static_cast<double>(outlines.size());
  double sum = 0.0, squares = 0.0;
  for (const SeenSize& one : outlines) sum += one.*side;
  const double mean = sum / count;
  if (mean <= 0.0) return {};
  for (const SeenSize& one : outlines) squares += std::pow(one.*side / mean - 1.0, 2);
  const double own = noise_of(outlines), flicker = squares / (count - 1.0) - own;
  const double variance = own * own + 2.0 * own * std::max(flicker, 0.0);
  return {flicker, std::max(std::sqrt(2.0 / (count - 1.0) * variance), 1e-6)};
}

Measured flicker_of(const std::vector<StationSizes>& by_station) {
  StationSizes clearest;
  for (const StationSizes& sizes : by_station) {
    StationSizes outlines = outlines_of(sizes);
    if (!show_flicker(outlines)) continue;
    if (clearest.empty() || noise_of(outlines) < noise_of(clearest)) clearest = std::move(outlines);
  }
  if (clearest.empty()) return {};
  const Measured along = flicker_of(clearest, &SeenSize::value_m);
  const Measured across = flicker_of(clearest, &SeenSize::across_m);
  return {along.value + across.value, std::hypot(along.sd, across.sd)};
}

Measured size_of(const std::vector<StationSizes>& by_station) {
  const StationSizes* best = nullptr;
  for (const StationSizes& sizes : by_station) {
    if (sizes.empty()) continue;
    if (best == nullptr || sizes.back().sd_m < best->back().sd_m) best = &sizes;
  }
  if (best == nullptr) return {};
  const auto count = static_cast<double>(best->size());
  double sum = 0.0, variance = 0.0;
  for (const SeenSize& one : *best) {
    sum += one.value_m;
    variance += one.sd_m * one.sd_m;
  }
  const double mean = sum / count;
  if (mean <= 0.0) return {};
  // Errors of a box are not independent from image to image: the mean is no better than one.
  return {mean, std::max(std::sqrt(variance / count), 1e-6)};
}

// The error may be as large as the height, so the slope at the height would not do: half the span
// from 1 sigma below to 1 sigma above.
Measured height_feature(const Measured& height_m) {
  constexpr double kScale_m = 10.0;
  const auto at = [&](double sigmas) {
    return std::asinh((height_m.value + sigmas * height_m.sd) / kScale_m);
  };
  return {at(0.0), 0.5 * (at(1.0) - at(-1.0))};
}

// Only size, speed and height, which persist from look to look; the others stay unknown.
Features lasting_of(const Features& seen) {
  Features lasting{};
  for (const int i : {0, 1, 5}) lasting[i] = seen[i];
  return lasting;
}

Features without_flicker(Features seen) {
  seen[kFlicker] = {};
  return seen;
}

}  // namespace

ClassLook look_at(const std::vector<StationSizes>& by_station,
                  const std::array<double, 3>& velocity_m_s,
                  const std::array<double, 3>& before_m_s, double apart_s, double velocity_sd_m_s) {
  ClassLook look;
  look.size_m = size_of(by_station);
  look.flicker = flicker_of(by_station);
  look.speed_m_s = {std::hypot(velocity_m_s[0], velocity_m_s[1]), velocity_sd_m_s};
  look.climb_m_s = {velocity_m_s[2], velocity_sd_m_s};
  if (apart_s <= 0.0) return look;
  std::array<double, 3> change{};
  double along = 0.0, speed2 = 1e-9, all = 0.0;
  for (int i = 0; i < 3; ++i) {
    change[i] = (velocity_m_s[i] - before_m_s[i]) / apart_s;
    along += change[i] * velocity_m_s[i];
    speed2 += velocity_m_s[i] * velocity_m_s[i];
    all += change[i] * change[i];
  }
  look.across_m_s2 = {std::sqrt(std::max(0.0, all - along * along / speed2)),
                      std::numbers::sqrt2 * velocity_sd_m_s / apart_s};
  return look;
}

Features features_of(const ClassLook& look) {
  const auto by = [](const Measured& of, double value, double slope) {
    return Measured{value, of.sd * slope};
  };
  const double size_m = std::max(look.size_m.value, 1e-3);
  const double speed = 1.0 + std::max(look.speed_m_s.value, 0.0);
  const double across = 1.0 + std::max(look.across_m_s2.value, 0.0);
  const double climb = look.climb_m_s.value;
  return {by(look.size_m, std::log(size_m), 1.0 / size_m),
          by(look.speed_m_s, std::log(speed), 1.0 / speed),
          by(look.climb_m_s, std::asinh(climb), 1.0 / std::hypot(1.0, climb)),
          by(look.across_m_s2, std::log(across), 1.0 / across),
          look.flicker,
          height_feature(look.height_m)};
}

void ClassPosterior::add(std::int64_t utime_us, const ClassLook& look) {
  static_assert(kKinds <= kMostKinds);
  const Features seen = features_of(look);
  if (look.size_m.sd <= 0.0) return;
  if (last_us_ && utime_us <= *last_us_) return;
  const double since_s = last_us_ ? 1e-6 * static_cast<double>(utime_us - *last_us_) : 0.0;
  const double kept = std::exp(-since_s / kMemory_s);
  const bool beats = seen[kFlicker].sd > 0.0;
  for (Sum* sum : {&lasting_, &moving_, &beating_}) {
    sum->fade(kept);
    if (sum == &beating_ && !beats) continue;
    if (sum->weight == 0.0) sum->first_us = utime_us;
    sum->last_us = utime_us;
    sum->weight += 1.0;
  }
  for (int i = 0; i < kKinds; ++i) {
    const double all = log_likelihood(kClassTable[i], seen);
    const double steady = log_likelihood(kClassTable[i], without_flicker(seen));
    const double lasting = log_likelihood(kClassTable[i], lasting_of(seen));
    lasting_.log[i] += lasting;
    moving_.log[i] += steady - lasting;
    beating_.log[i] += all - steady;  // 0 if the flicker is unknown
  }
  if (!first_us_) first_us_ = utime_us;
  last_us_ = utime_us;
}

void ClassPosterior::Sum::fade(double kept) {
  weight *= kept;
  for (double& one : log) one *= kept;
}

double ClassPosterior::Sum::looks(std::int64_t now_us) const {
  const double seen_s = 1e-6 * static_cast<double>(last_us - first_us);
  const double since_s = 1e-6 * static_cast<double>(now_us - last_us);
  const double independent = std::min({1.0 + seen_s / kCorrelation_s, kMostLooks, weight});
  return std::max(independent, 1.0) * std::exp(-since_s / kMemory_s);
}

std::array<double, kObjectClasses> ClassPosterior::posterior() const {
  std::array<double, kObjectClasses> of_classes{};
  if (!last_us_) return of_classes;
  std::array<double, kKinds> log{};
  for (int i = 0; i < kKinds; ++i) {
    log[i] = std::log(kClassTable[i].prior) + lasting_.mean(i);
    for (const Sum* sum : {&moving_, &beating_}) log[i] += sum->looks(*last_us_) * sum->mean(i);
  }
  const double all = log_sum(log.data(), kKinds);
  for (int i = 0; i < kKinds; ++i)
    of_classes[static_cast<int>(kClassTable[i].object_class)] += std::exp(log[i] - all);
  return of_classes;
}

ClassBelief ClassPosterior::belief() const {
  if (!last_us_ || 1e-6 * static_cast<double>(*last_us_ - *first_us_) < kLeastSeen_s) return {};
  const auto all = posterior();
  const auto most = std::ranges::max_element(all);
  if (*most < kSure) return {};
  return {static_cast<ObjectClass>(most - all.begin()), *most};
}

}  // namespace ols::fusion
