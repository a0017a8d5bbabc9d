#include "central/offline_fusion.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <stdexcept>

namespace ols {
namespace {

using Recording = std::map<std::string, std::vector<Sighting>>;  // by station, in order of time

Recording recording_of(const std::vector<Sighting>& sightings, double min_belief,
                       UnusedBearings& unused) {
  Recording recording;
  for (const Sighting& sighting : sightings) {
    if (sighting.belief >= min_belief) {
      recording[sighting.station].push_back(sighting);
    } else {
      ++unused.low_belief;
    }
  }
  for (auto& [name, all] : recording) {
    std::ranges::stable_sort(all, {}, &Sighting::utime_us);
    const auto same_instant = [](const Sighting& a, const Sighting& b) {
      return a.utime_us == b.utime_us;
    };
    const auto first_doubled = std::unique(all.begin(), all.end(), same_instant);
    unused.duplicate += static_cast<std::size_t>(all.end() - first_doubled);
    all.erase(first_doubled, all.end());
  }
  return recording;
}

void require_reasonable(double rate_hz, double span_s) {
  constexpr double kMostEpochs = 10e6;
  if (!std::isfinite(rate_hz)) throw std::invalid_argument("the rate is not a finite number");
  if (rate_hz > 0.0 && span_s * rate_hz > kMostEpochs) {
    std::ostringstream what;
    what << "a rate of " << rate_hz << " Hz over " << span_s << " s makes more than " << kMostEpochs
         << " epochs";
    throw std::invalid_argument(what.str());
  }
}

std::vector<std::int64_t> epochs_of(const Recording& recording, double rate_hz) {
  std::vector<std::int64_t> epochs;
  for (const auto& [name, all] : recording) {
    for (const Sighting& sighting : all) epochs.push_back(sighting.utime_us);
  }
  std::ranges::sort(epochs);
  epochs.erase(std::unique(epochs.begin(), epochs.end()), epochs.end());
  if (epochs.empty()) return epochs;
  require_reasonable(rate_hz, static_cast<double>(epochs.back() - epochs.front()) * 1e-6);
  if (rate_hz <= 0.0) return epochs;
  std::vector<std::int64_t> grid;
  for (std::int64_t i = 0;; ++i) {
    const auto offset_us = std::llround(static_cast<double>(i) * 1e6 / rate_hz);
    if (epochs.front() + offset_us > epochs.back()) return grid;
    grid.push_back(epochs.front() + offset_us);
  }
}

// A position is news of the range for so long.
constexpr std::int64_t kNearUs = 1'000'000;

// The state of one pass through the recording.
class Pass {
 public:
  Pass(const Recording& recording, const OfflineConfig& config, ResidualMonitor& monitor)
      : recording_(recording), config_(config), monitor_(monitor) {}

  FusedTarget locate(std::int64_t epoch_us) {
    std::vector<Ray> rays = rays_at(epoch_us);
    // What the covariances leave out is learnt from the joint fit, whoever estimates.
    Estimate joint = least_squares(rays, config_.fusion.least_squares);
    monitor_.observe(rays, joint, epoch_us);
    if (joint.solution == Solution::kOk) {
      last_us_ = epoch_us;
      last_position_ = joint.position_ecef;
    }
    FusedTarget target;
    target.utime_us = epoch_us;
    if (config_.estimator == OfflineEstimator::kLeastSquares) {
      target.estimator = "least-squares";
      if (joint.solution == Solution::kOk) estimate_velocity(rays, joint);
      target.estimate = std::move(joint);
    } else {
      const bool best = config_.estimator == OfflineEstimator::kPaperBestBaseline;
      target.estimator = best ? "paper-best-baseline" : "paper";
      target.estimate =
          paper_estimate(best ? paper_best_baseline : paper_n_view, rays, config_.fusion.paper);
    }
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const RayUse& use = target.estimate.rays[i];
      target.stations.push_back({rays[i].station, use.used, use.weight, rays[i].age_s});
    }
    return target;
  }

 private:
  std::vector<Ray> rays_at(std::int64_t epoch_us) const {
    std::vector<Ray> rays;
    for (const auto& [name, all] : recording_) {
      std::optional<double> range_m;
      if (epoch_us - last_us_ < kNearUs) {
        range_m = (last_position_ - all.front().sight.origin_ecef).norm();
      }
      auto ray = align(all, epoch_us, range_m, config_.fusion.alignment);
      if (!ray) continue;
      monitor_.inflate(*ray);
      rays.push_back(std::move(*ray));
    }
    return rays;
  }

  const Recording& recording_;
  const OfflineConfig& config_;
  ResidualMonitor& monitor_;
  std::int64_t last_us_ = -kNearUs;
  Eigen::Vector3d last_position_ = Eigen::Vector3d::Zero();
};

void average(std::vector<FusedTarget>& targets, int h) {
  constexpr std::int64_t kGapUs = 1'000'000;
  MovingAverage moving(h);
  std::optional<std::int64_t> last_us;
  for (FusedTarget& target : targets) {
    if (last_us && target.utime_us - *last_us > kGapUs) moving.reset();
    last_us = target.utime_us;
    target.estimate = moving.add(target.estimate);
  }
}

}  // namespace

std::optional<OfflineEstimator> offline_estimator(std::string_view name) {
  if (name == "least-squares") return OfflineEstimator::kLeastSquares;
  if (name == "paper") return OfflineEstimator::kPaper;
  if (name == "paper-best-baseline") return OfflineEstimator::kPaperBestBaseline;
  return std::nullopt;
}

UnusedBearings unused_bearings(const std::vector<Sighting>& sightings,
                               const OfflineConfig& config) {
  UnusedBearings unused;
  recording_of(sightings, config.fusion.min_belief, unused);
  return unused;
}

std::vector<FusedTarget> fuse_offline(const std::vector<Sighting>& sightings,
                                      const OfflineConfig& config) {
  UnusedBearings unused;
  const Recording recording = recording_of(sightings, config.fusion.min_belief, unused);
  const std::vector<std::int64_t> epochs = epochs_of(recording, config.rate_hz);
  ResidualMonitor monitor(config.fusion.residuals);
  std::vector<FusedTarget> targets;
  for (int pass = 0; pass < config.passes; ++pass) {
    targets.clear();
    Pass state(recording, config, monitor);
    for (const std::int64_t epoch_us : epochs) {
      FusedTarget target = state.locate(epoch_us);
      if (target.estimate.solution == Solution::kOk) targets.push_back(std::move(target));
    }
  }
  if (config.moving_average > 1) average(targets, config.moving_average);
  return targets;
}

}  // namespace ols
