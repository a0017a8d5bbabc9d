#include "central/classify/class_posterior.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <string_view>

#include "central/classify/class_table.h"

namespace ols::fusion {
namespace {

constexpr std::size_t kLeastSizes = 8;  // fewer determine no flicker
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

// Relative variance of one side of the outline, minus that of its noise. The relative noise of both
// sides is the same. Sizes without a noise were measured in another way, and are left out.
Measured flicker_of(const std::vector<SeenSize>& sizes, double SeenSize::*side) {
  std::vector<SeenSize> outlines;
  std::ranges::copy_if(sizes, std::back_inserter(outlines),
                       [](const SeenSize& one) { return one.noise_m > 0.0; });
  const auto count = static_cast<double>(outlines.size());
  double sum = 0.0, squares = 0.0, noise = 0.0;
  for (const SeenSize& one : outlines) sum += one.*side;
  const double mean = sum / count;
  if (outlines.size() < kLeastSizes || mean <= 0.0) return {};
  for (const SeenSize& one : outlines) {
    squares += std::pow(one.*side / mean - 1.0, 2);
    noise += std::pow(one.noise_m / one.value_m, 2);
  }
  const double own = noise / count, flicker = squares / (count - 1.0) - own;
  const double variance = own * own + 2.0 * own * std::max(flicker, 0.0);
  return {flicker, std::max(std::sqrt(2.0 / (count - 1.0) * variance), 1e-6)};
}

// The sizes are those of one second. Their mean is the object's size, their variation its flicker.
void see_sizes(const std::vector<SeenSize>& sizes, ClassLook& look) {
  const auto count = static_cast<double>(sizes.size());
  if (sizes.empty()) return;
  double sum = 0.0, variance = 0.0;
  for (const SeenSize& one : sizes) {
    sum += one.value_m;
    variance += one.sd_m * one.sd_m;
  }
  const double mean = sum / count;
  if (mean <= 0.0) return;
  // Errors of a box are not independent from image to image: the mean is no better than one.
  look.size_m = {mean, std::max(std::sqrt(variance / count), 1e-6)};
  const Measured along = flicker_of(sizes, &SeenSize::value_m);
  const Measured across = flicker_of(sizes, &SeenSize::across_m);
  look.flicker = {along.value + across.value, std::hypot(along.sd, across.sd)};
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

}  // namespace

ClassLook look_at(const std::vector<SeenSize>& sizes, const std::array<double, 3>& velocity_m_s,
                  const std::array<double, 3>& before_m_s, double apart_s, double velocity_sd_m_s) {
  ClassLook look;
  see_sizes(sizes, look);
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
  weight_ = weight_ * kept + 1.0;
  for (int i = 0; i < kKinds; ++i) {
    sum_[i] = sum_[i] * kept + log_likelihood(kClassTable[i], seen);
    lasting_[i] = lasting_[i] * kept + log_likelihood(kClassTable[i], lasting_of(seen));
  }
  if (!first_us_) first_us_ = utime_us;
  last_us_ = utime_us;
}

std::array<double, kObjectClasses> ClassPosterior::posterior() const {
  std::array<double, kObjectClasses> of_classes{};
  if (!last_us_) return of_classes;
  const double seen_s = 1e-6 * static_cast<double>(*last_us_ - *first_us_);
  const double looks = std::min(1.0 + seen_s / kCorrelation_s, kMostLooks);
  std::array<double, kKinds> log{};
  for (int i = 0; i < kKinds; ++i)
    log[i] =
        std::log(kClassTable[i].prior) + (lasting_[i] + looks * (sum_[i] - lasting_[i])) / weight_;
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
