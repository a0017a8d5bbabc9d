#include "central/tracking/target_appearance.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace ols::fusion {
namespace {

constexpr std::size_t kClasses = static_cast<std::size_t>(ObjectClass::kOther) + 1;

class Sum {
 public:
  void add(const Sighted& seen, double range_m) {
    best_.signal = std::max(best_.signal, seen.signal);
    if (seen.size_rad > 0.0 && seen.size_sd_rad > 0.0) {
      const double weight = std::pow(range_m * seen.size_sd_rad, -2);
      weights_ += weight;
      sizes_ += weight * range_m * seen.size_rad;
    }
    if (seen.class_probability.size() == kClasses) add_classes(seen.class_probability);
  }

  Appearance appearance() const {
    Appearance all = best_;
    if (weights_ > 0.0) {
      all.size_m = sizes_ / weights_;
      all.size_sd_m = 1.0 / std::sqrt(weights_);
    }
    if (log_.empty()) return all;
    const auto most = std::ranges::max_element(log_);
    double sum = 0.0;
    for (const double value : log_) sum += std::exp(value - *most);
    all.object_class = static_cast<ObjectClass>(most - log_.begin());
    all.class_probability = 1.0 / sum;
    return all;
  }

 private:
  void add_classes(const std::vector<double>& probability) {
    constexpr double kLeast = 1e-3;  // one station alone excludes nothing
    log_.resize(kClasses, 0.0);
    for (std::size_t i = 0; i < kClasses; ++i)
      log_[i] += std::log(std::max(probability[i], kLeast));
  }

  Appearance best_;
  double weights_ = 0.0, sizes_ = 0.0;
  std::vector<double> log_;  // of each class
};

}  // namespace

Appearance appearance_of(const Track& track, const Eigen::Vector3d& p_ecef) {
  Sum sum;
  for (const auto& [station, bearings] : track.bearings) {
    if (bearings.empty()) continue;
    const BearingMeasurement& newest = bearings.back();
    sum.add(newest.sighted, (p_ecef - newest.sight.origin_ecef).norm());
  }
  return sum.appearance();
}

}  // namespace ols::fusion
