#include "calibration/light_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace ols::calibration {
namespace {

constexpr std::size_t kFewest = 50;
constexpr double kLeastContrast = 8.0;  // sigmas
constexpr int kExposures = 6;
constexpr int kCoarse = 300, kFine = 200;  // steps of the delay

// How long the light was on from the beginning of a period to `time_s`, which counts from there and
// may be any number.
double lit_until(double time_s, const BlinkingLight& light) {
  const double periods = std::floor(time_s / light.period_s);
  return periods * light.lit_s + std::min(time_s - periods * light.period_s, light.lit_s);
}

double lit_share(double time_s, double exposure_s, const BlinkingLight& light) {
  return (lit_until(time_s + 0.5 * exposure_s, light) -
          lit_until(time_s - 0.5 * exposure_s, light)) /
         exposure_s;
}

struct Explained {
  double squares = 0.0;   // sum of the squared residuals
  double contrast = 0.0;  // brightness of the light by its sigma; negative: it is darker
};

// The brightness as a constant and a share of the light, by least squares.
Explained explain(const std::vector<LightSample>& samples, double late_s, double exposure_s,
                  const BlinkingLight& light) {
  double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;
  for (const LightSample& sample : samples) {
    const double share = lit_share(sample.time_s - late_s, exposure_s, light);
    n += 1.0;
    x += share;
    y += sample.brightness;
    xx += share * share;
    xy += share * sample.brightness;
    yy += sample.brightness * sample.brightness;
  }
  const double spread = xx - x * x / n, common = xy - x * y / n, all = yy - y * y / n;
  if (!(spread > 1e-9 * n)) return {all, 0.0};
  const double squares = std::max(all - common * common / spread, 1e-12 * all);
  return {squares, common / spread / std::sqrt(squares / (n - 2.0) / spread)};
}

struct PossibleDelay {
  double late_s, log_likelihood, contrast, exposure_s;
};

// The delays from `from_s` on, each with its best exposure.
std::vector<PossibleDelay> possible_delays(const std::vector<LightSample>& samples,
                                           const BlinkingLight& light, double from_s, double step_s,
                                           int count) {
  const double longest_s = 0.5 * std::min(light.lit_s, light.period_s - light.lit_s);
  std::vector<PossibleDelay> all;
  for (int i = 0; i < count; ++i) {
    PossibleDelay best{from_s + i * step_s, -std::numeric_limits<double>::infinity(), 0.0, 0.0};
    for (int k = 1; k <= kExposures; ++k) {
      const double exposure_s = longest_s * k / kExposures;
      const Explained by = explain(samples, best.late_s, exposure_s, light);
      const double log_likelihood =
          -0.5 * static_cast<double>(samples.size()) * std::log(by.squares);
      if (log_likelihood <= best.log_likelihood) continue;
      best.log_likelihood = log_likelihood;
      best.contrast = by.contrast;
      best.exposure_s = exposure_s;
    }
    all.push_back(best);
  }
  return all;
}

const PossibleDelay& likeliest(const std::vector<PossibleDelay>& all) {
  return *std::ranges::max_element(all, {}, &PossibleDelay::log_likelihood);
}

// The mean of the likelihood and its 1-sigma.
Measured mean_of(const std::vector<PossibleDelay>& all, double step_s) {
  const double highest = likeliest(all).log_likelihood;
  double weights = 0.0, sum = 0.0, squares = 0.0;
  for (const PossibleDelay& one : all) {
    const double weight = std::exp(one.log_likelihood - highest);
    weights += weight;
    sum += weight * one.late_s;
    squares += weight * one.late_s * one.late_s;
  }
  const double mean_s = sum / weights;
  const double variance_s2 = std::max(0.0, squares / weights - mean_s * mean_s);
  return {mean_s, std::sqrt(variance_s2 + step_s * step_s / 12.0)};
}

// The samples while the light goes on or off. Only these show the delay, and their residuals
// contain the jitter of the times. All samples, if there are too few such.
std::vector<LightSample> at_edges(const std::vector<LightSample>& samples,
                                  const PossibleDelay& delay, const BlinkingLight& light) {
  std::vector<LightSample> near;
  for (const LightSample& sample : samples) {
    const double on_s = std::remainder(sample.time_s - delay.late_s, light.period_s);
    const double off_s = std::remainder(sample.time_s - delay.late_s - light.lit_s, light.period_s);
    if (std::min(std::abs(on_s), std::abs(off_s)) < delay.exposure_s) near.push_back(sample);
  }
  return near.size() < kFewest ? samples : near;
}

}  // namespace

LightFit fit_light(const std::vector<LightSample>& samples, const BlinkingLight& light) {
  if (!(light.period_s > 0.0 && light.lit_s > 0.0 && light.lit_s < light.period_s)) {
    throw std::invalid_argument("a light is on for a part of its period");
  }
  if (samples.size() < kFewest) throw std::invalid_argument("too few pictures of the light");
  const double coarse_s = light.period_s / kCoarse;
  const auto all = possible_delays(samples, light, -0.5 * light.period_s, coarse_s, kCoarse);
  const PossibleDelay& best = likeliest(all);
  LightFit fit{.contrast = best.contrast};
  if (best.contrast < kLeastContrast) return fit;
  // All likely delays lie around the best one, or the light cannot tell them apart.
  constexpr double kUnlikely = 8.0;  // [log]
  const double reach_s = 0.25 * light.period_s;
  double from_s = best.late_s, to_s = best.late_s;
  for (const PossibleDelay& one : all) {
    if (one.log_likelihood < best.log_likelihood - kUnlikely) continue;
    const double off_s = std::remainder(one.late_s - best.late_s, light.period_s);
    if (std::abs(off_s) > reach_s) return fit;
    from_s = std::min(from_s, best.late_s + off_s);
    to_s = std::max(to_s, best.late_s + off_s);
  }
  from_s -= 2.0 * coarse_s;
  const double fine_s = (to_s + 2.0 * coarse_s - from_s) / kFine;
  const auto edges = at_edges(samples, best, light);
  fit.late_s = mean_of(possible_delays(edges, light, from_s, fine_s, kFine + 1), fine_s);
  return fit;
}

}  // namespace ols::calibration
