#include "central/tracking/position_guard.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace ols::fusion {
namespace {

bool heard_lately(const TrackFilter& filter, const FilterStation& station, double within_s) {
  return station.used > 0 && station.last_used.within(within_s, filter.utime_us());
}

double may_be_off(const TrackFilter& filter, const FilterStation& station) {
  const bool states_pose = !station.sight.covariance_systematic.isZero(0.0);
  return states_pose ? 0.0 : filter.config().undeclared_sd_rad;
}

// A station that declares its errors counts. Any other counts only while its bearings may still
// correct the others' biases, and not with a single bearing if others have more: if two rays have
// intersected far from the truth, a single bearing seems certain but proves nothing.
std::vector<const FilterStation*> that_count(const TrackFilter& filter) {
  constexpr int kTwice = 2;
  std::vector<const FilterStation*> found;
  int most = 0;
  filter.each_station([&](const FilterStation& s) { most = std::max(most, s.used); });
  filter.each_station([&](const FilterStation& station) {
    const bool declares = may_be_off(filter, station) == 0.0;
    const bool enough = station.used >= std::min(most, kTwice);
    const bool may_hold = enough && heard_lately(filter, station, Activity::kTeachesS);
    if (declares || may_hold) found.push_back(&station);
  });
  return found;
}

// Two rays determine no range, however small its variance, if they cross at a smaller angle than
// their undeclared errors divided by the required accuracy of the range: their residuals only show
// the undeclared errors.
bool crosses_widely(const TrackFilter& filter, const Eigen::Vector3d& p_ecef) {
  const std::vector<const FilterStation*> stations = that_count(filter);
  for (std::size_t i = 0; i < stations.size(); ++i) {
    for (std::size_t k = i + 1; k < stations.size(); ++k) {
      const double off_rad =
          std::hypot(may_be_off(filter, *stations[i]), may_be_off(filter, *stations[k]));
      const double least_rad = off_rad / filter.config().range_sd_limit;
      const Eigen::Vector3d a = p_ecef - stations[i]->sight.origin_ecef;
      const Eigen::Vector3d b = p_ecef - stations[k]->sight.origin_ecef;
      if (a.cross(b).norm() >= std::sin(least_rad) * a.norm() * b.norm()) return true;
    }
  }
  return false;
}

double nearest_m(const TrackFilter& filter, const KinematicState& state) {
  double nearest = std::numeric_limits<double>::infinity();
  filter.each_station([&](const FilterStation& station) {
    nearest = std::min(nearest, (state.mean.head<3>() - station.sight.origin_ecef).norm());
  });
  return nearest;
}

}  // namespace

bool is_inconsistent_pair(const TrackFilter& filter) {
  if (stations_lately(filter, Activity::kSupportsS) != 2) return false;
  const auto& stations = filter.stations();
  double squared = 0.0;
  for (std::size_t i = 0; i < stations.size(); ++i) {
    if (!heard_lately(filter, stations[i], Activity::kSupportsS)) continue;
    const LineOfSight& sight = stations[i].sight;
    const double range_m = (filter.position() - sight.origin_ecef).norm();
    const Eigen::Matrix2d stated = stated_covariance(sight, range_m) + sight.covariance_white;
    const Eigen::Vector2d bias_rad = filter.bias(i).bias_rad;
    squared += bias_rad.dot(stated.llt().solve(bias_rad));
  }
  return squared > filter.config().two_stations_nis;
}

int consecutive_rejections(const TrackFilter& filter, std::int64_t now_us) {
  int most = 0;
  filter.each_station([&](const FilterStation& station) {
    const bool delivers = station.last_offered.within(Activity::kContributesS, now_us);
    const bool counts = delivers && station.rejected > most;
    if (counts && filter.agreed_since(station) < 2) most = station.rejected;
  });
  return most;
}

bool has_range(const TrackFilter& filter, const KinematicState& state, double share) {
  const Eigen::Matrix3d P = state.covariance.topLeftCorner<3, 3>();
  const double greatest =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(P, Eigen::EigenvaluesOnly).eigenvalues()(2);
  const double limit_m = share * nearest_m(filter, state);
  return greatest < limit_m * limit_m;
}

Solution judge_position(const TrackFilter& filter, const KinematicState& state) {
  if (filter.stations().size() < 2) return Solution::kTooFewRays;
  if (!has_range(filter, state, filter.config().range_sd_limit)) {
    return stations_lately(filter, Activity::kFollowsS) < 2 ? Solution::kTooFewRays
                                                            : Solution::kParallelRays;
  }
  if (!crosses_widely(filter, state.mean.head<3>())) return Solution::kParallelRays;
  if (nearest_m(filter, state) > filter.config().max_range_m) return Solution::kTooFar;
  const bool miss = consecutive_rejections(filter, filter.utime_us()) >= kMaxConsecutiveRejections;
  return miss || is_inconsistent_pair(filter) ? Solution::kRaysMiss : Solution::kOk;
}

int stations_lately(const TrackFilter& filter, double within_s) {
  int count = 0;
  filter.each_station(
      [&](const FilterStation& s) { count += heard_lately(filter, s, within_s) ? 1 : 0; });
  return count;
}

}  // namespace ols::fusion
