#include "central/tracking/target_appearance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "central/ground/above_ground.h"
#include "central/measurement/time_span.h"
#include "geometry/wgs84.h"

namespace ols::fusion {
namespace {

constexpr std::size_t kClasses = kObjectClasses;

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

  Appearance appearance(const ClassBelief& known) const {
    Appearance all = best_;
    if (weights_ > 0.0) {
      all.size_m = sizes_ / weights_;
      all.size_sd_m = 1.0 / std::sqrt(weights_);
    }
    if (log_.empty()) {
      all.object_class = known.object_class;
      all.class_probability = known.probability;
      return all;
    }
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

bool is_sighted(const BearingMeasurement& m) { return m.sighted.has_appearance(); }

bool may_be_sighted(const Track& track, const std::vector<BearingMeasurement>& bearings) {
  return !bearings.empty() && track.last.appearance_us >= bearings.front().utime_us;
}

// What each station has seen within the last second. (The track also has the last bearings of a
// station that no longer sees it.)
std::vector<StationSizes> sizes_of(const Track& track, const KinematicState& state) {
  constexpr double kLatest_s = 1.0;
  std::vector<StationSizes> all;
  for (const auto& [station, bearings] : track.bearings) {
    if (!may_be_sighted(track, bearings)) continue;
    StationSizes& sizes = all.emplace_back();
    for (const BearingMeasurement& m : bearings) {
      if (m.sighted.size_rad <= 0.0 || m.sighted.size_sd_rad <= 0.0) continue;
      const double time_s = seconds(m.utime_us - state.utime_us);
      if (time_s < -kLatest_s) continue;
      const double range_m = (state.mean.head<3>() - m.sight.origin_ecef).norm();
      sizes.push_back({range_m * m.sighted.size_rad, range_m * m.sighted.size_sd_rad,
                       range_m * m.sighted.size_noise_rad, range_m * m.sighted.across_rad, time_s});
    }
  }
  return all;
}

// Where the land is unknown, it is taken as flat around the nearest station. If the object is below
// that level, the land is not flat, and nothing is known of the object's height.
Measured height_of(const Track& track, const KinematicState& state, const land::Surface* surface) {
  constexpr double kRise = 0.2, kLeast_m = 5.0;  // 1-sigma of the land, by the distance
  const Eigen::Vector3d position = state.mean.head<3>();
  const Eigen::Matrix3d P = state.covariance.topLeftCorner<3, 3>();
  if (surface != nullptr) {
    if (const auto above = height_above_ground(*surface, position, P))
      return {above->height_m, above->sd_m};
  }
  const LocalFrame below(geodetic_from_ecef(position));
  std::optional<Eigen::Vector3d> nearest;
  for (const auto& [station, bearings] : track.bearings) {
    if (bearings.empty()) continue;
    const Eigen::Vector3d there = below.to_enu(bearings.back().sight.origin_ecef);
    if (!nearest || there.norm() < nearest->norm()) nearest = there;
  }
  if (!nearest) return {};
  const Eigen::Vector3d up = below.R_ecef_enu().transpose().col(2);
  const double height_m = -nearest->z();
  const double sd_m =
      std::hypot(kLeast_m, kRise * nearest->head<2>().norm(), std::sqrt(up.dot(P * up)));
  if (height_m < -sd_m) return {};
  return {height_m, sd_m};
}

}  // namespace

void look_at_class(Track& track, const land::Surface* surface) {
  constexpr std::int64_t kPause_us = 200'000, kBefore_us = 1'000'000;
  const KinematicState& state = track.filter.summary();
  auto& velocities = track.velocities;
  if (!velocities.empty() && state.utime_us - velocities.rbegin()->first < kPause_us) return;
  const Eigen::Vector3d position = state.mean.head<3>(), velocity = state.mean.segment<3>(3);
  velocities[state.utime_us] = velocity;
  while (velocities.size() > 1 && state.utime_us - velocities.begin()->first > kBefore_us)
    velocities.erase(velocities.begin());
  const auto& [before_us, before] = *velocities.begin();
  const Eigen::Matrix3d R = R_ecef_enu(position).transpose();
  const auto enu = [&R](const Eigen::Vector3d& v) {
    const Eigen::Vector3d turned = R * v;
    return std::array<double, 3>{turned.x(), turned.y(), turned.z()};
  };
  const double sd = std::sqrt(state.covariance.block<3, 3>(3, 3).trace() / 3.0);
  const std::int64_t apart_us = state.utime_us - before_us;
  // Velocities that are closer in time differ only by noise.
  ClassLook look = look_at(sizes_of(track, state), enu(velocity), enu(before),
                           apart_us > kBefore_us / 2 ? seconds(apart_us) : 0.0, sd);
  look.height_m = height_of(track, state, surface);
  track.classes.add(state.utime_us, look);
}

Appearance appearance_of(const Track& track, const Eigen::Vector3d& p_ecef) {
  Sum sum;
  for (const auto& [station, bearings] : track.bearings) {
    if (!may_be_sighted(track, bearings)) continue;
    // A tracker's bearings are more frequent than the detector's images.
    const auto newest = std::ranges::find_if(bearings.rbegin(), bearings.rend(), is_sighted);
    if (newest == bearings.rend()) continue;
    sum.add(newest->sighted, (p_ecef - newest->sight.origin_ecef).norm());
  }
  return sum.appearance(track.classes.belief());
}

}  // namespace ols::fusion
