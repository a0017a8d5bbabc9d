#include "central/estimators/estimator.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "central/estimators/position_covariance.h"
#include "central/measurement/time_span.h"
#include "central/tracking/position_guard.h"
#include "geometry/angles.h"

namespace ols::fusion {
namespace {

constexpr double kRangeIsNewsS = 1.0;  // how long a position's range is used
constexpr double kAverageGapS = 1.0;   // the moving average restarts after a longer gap

class FilterEstimator : public Estimator {
 public:
  const char* name() const override { return "filter"; }
  Located locate(const TrackView& target, std::int64_t epoch_us) override {
    if (target.filter == nullptr) return {};
    const KinematicState state = target.filter->at(epoch_us);
    return {estimate_of(*target.filter, state, target.filter->systematic()),
            contributing(*target.filter, epoch_us)};
  }
};

// An estimator that uses the rays of one instant.
class RayEstimator : public Estimator {
 public:
  explicit RayEstimator(const EstimatorConfig& config) : config_(config) {}
  Located locate(const TrackView& target, std::int64_t epoch_us) override {
    const std::vector<Ray> rays = rays_at(target, epoch_us);
    Located located{solve(rays, epoch_us), {}};
    if (located.estimate.solution == Solution::kOk) {
      located_us_ = epoch_us;
      position_ = located.estimate.position_ecef;
    }
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const RayUse& use = located.estimate.rays[i];
      located.stations.push_back({rays[i].station, use.used, use.weight, rays[i].age_s});
    }
    return located;
  }

 protected:
  virtual Estimate solve(const std::vector<Ray>& rays, std::int64_t epoch_us) = 0;
  // How many stations at most; the first ones.
  virtual std::size_t most_rays() const { return std::numeric_limits<std::size_t>::max(); }
  const EstimatorConfig& config() const { return config_; }

 private:
  std::vector<Ray> rays_at(const TrackView& target, std::int64_t epoch_us) const {
    std::vector<Ray> rays;
    for (const auto& [station, bearings] : target.bearings) {
      if (rays.size() >= most_rays()) break;
      if (bearings.empty()) continue;
      std::optional<double> range_m;
      if (located_us_ && seconds(epoch_us - *located_us_) < kRangeIsNewsS) {
        range_m = (position_ - bearings.back().sight.origin_ecef).norm();
      }
      auto ray =
          align(bearings, epoch_us, range_m, config_.alignment, target.errors.noise_scale(station));
      if (!ray) continue;
      ray->sight.covariance_systematic += target.errors.undeclared(station, bearings.back().sight);
      rays.push_back(std::move(*ray));
    }
    return rays;
  }

  EstimatorConfig config_;
  std::optional<std::int64_t> located_us_;
  Eigen::Vector3d position_ = Eigen::Vector3d::Zero();
};

class LeastSquaresEstimator : public RayEstimator {
 public:
  using RayEstimator::RayEstimator;
  const char* name() const override { return "least-squares"; }

 protected:
  Estimate solve(const std::vector<Ray>& rays, std::int64_t) override {
    Estimate joint = least_squares(rays, config().least_squares);
    if (joint.solution == Solution::kOk) estimate_velocity(rays, joint);
    return joint;
  }
};

class PaperEstimator : public RayEstimator {
 public:
  explicit PaperEstimator(const EstimatorConfig& config)
      : RayEstimator(config), average_(config.paper.moving_average, config.alignment.window_s) {}
  const char* name() const override { return "paper"; }

 protected:
  Estimate solve(const std::vector<Ray>& rays, std::int64_t epoch_us) override {
    const Estimate estimate = paper_estimate(rays, config().paper);
    if (estimate.solution != Solution::kOk) return estimate;
    if (last_us_ && seconds(epoch_us - *last_us_) > kAverageGapS) average_.reset();
    last_us_ = epoch_us;
    return average_.add(estimate, epoch_us);
  }
  std::size_t most_rays() const override {
    const int most = config().paper.max_stations;
    return most > 0 ? static_cast<std::size_t>(most) : RayEstimator::most_rays();
  }

 private:
  MovingAverage average_;
  std::optional<std::int64_t> last_us_;
};

// The largest angle between the directions from a position to any two of them.
double greatest_crossing(const std::vector<FilterStation>& stations,
                         const Eigen::Vector3d& p_ecef) {
  double greatest = 0.0;
  for (std::size_t i = 0; i < stations.size(); ++i) {
    for (std::size_t j = i + 1; j < stations.size(); ++j) {
      const double angle = angle_between(p_ecef - stations[i].sight.origin_ecef,
                                         p_ecef - stations[j].sight.origin_ecef);
      greatest = std::max(greatest, std::min(angle, kPi - angle));
    }
  }
  return greatest;
}

// Reports only the stations whose bearings currently determine the position.
void tell_geometry(const TrackFilter& filter, std::int64_t utime_us, Estimate& estimate) {
  std::vector<FilterStation> stations = filter.stations();
  std::erase_if(stations, [&](const FilterStation& station) {
    return !station.last_used.within(Activity::kContributesS, utime_us);
  });
  estimate.crossing_angle_rad = greatest_crossing(stations, estimate.position_ecef);
  if (stations.empty()) return;
  double sum = 0.0;
  for (const FilterStation& station : stations) sum += station.mean_nis;
  estimate.residual = std::sqrt(sum / (2.0 * static_cast<double>(stations.size())));
}

}  // namespace

std::vector<ContributingStation> contributing(const TrackFilter& filter, std::int64_t epoch_us) {
  std::vector<ContributingStation> stations;
  filter.each_station([&](const FilterStation& station) {
    if (!station.last_offered.within(Activity::kContributesS, epoch_us)) return;
    const double age_s = station.last_offered.age_s(epoch_us);
    stations.push_back({station.station, station.weight > 0.0, station.weight, age_s});
  });
  std::ranges::sort(stations, {}, &ContributingStation::station);
  return stations;
}

Estimate estimate_of(const TrackFilter& filter, const KinematicState& state,
                     const SystematicPart& systematic) {
  Estimate estimate;
  estimate.solution = judge_position(filter, state);
  if (estimate.solution != Solution::kOk) return estimate;
  estimate.position_ecef = state.mean.head<3>();
  estimate.covariance_ecef = state.covariance.topLeftCorner<3, 3>();
  estimate.covariance_white_ecef = estimate.covariance_ecef - systematic.all_m2;
  estimate.covariance_ecef += filter.config().common_mode * systematic.empirical_m2;
  estimate.velocity_ecef = state.mean.segment<3>(3);
  estimate.velocity_covariance_ecef = state.covariance.block<3, 3>(3, 3);
  tell_geometry(filter, state.utime_us, estimate);
  return checked(std::move(estimate));
}

std::unique_ptr<Estimator> make_estimator(std::string_view name, const EstimatorConfig& config) {
  if (name == "filter") return std::make_unique<FilterEstimator>();
  if (name == "least-squares") return std::make_unique<LeastSquaresEstimator>(config);
  if (name == "paper") return std::make_unique<PaperEstimator>(config);
  return nullptr;
}

}  // namespace ols::fusion
