#include "central/filter/bias_model.h"

#include <algorithm>
#include <cmath>

#include "central/measurement/ray.h"

namespace ols::fusion {
namespace {

// What the white share of so many second differences may be off by chance, 1-sigma. That much is
// taken as white: what a few images show would count tenfold at a hundred images a second.
double by_chance(double weight, double differences) {
  return 1.0 / std::sqrt(weight + differences);
}

bool states_anything(const Eigen::Array2d& stated_rad2) { return stated_rad2.maxCoeff() > 0.0; }

// The share of what both axes have that is taken to be fixed in the camera; the rest is tilt.
// Nobody states it: with a half either may be all of it.
constexpr double kCameraShare = 0.5;

// A tilt affects both axes. A heading error affects only cross-elevation: it is what tilts leave of
// that axis. camera: the part of elevation that is fixed in the camera.
Eigen::Array3d rotation_variance(const Eigen::Array2d& bias_rad2, double camera,
                                 double elevation_rad) {
  constexpr double kLevel = 1e-3;  // towards the zenith a heading is hardly observable
  const double up = std::pow(std::sin(elevation_rad), 2), level = std::max(kLevel, 1.0 - up);
  const double tilt = bias_rad2.y() - camera;
  return {tilt, tilt, std::max(0.0, (bias_rad2.x() - tilt * up) / level)};
}

}  // namespace

// The offset is constant on the target, and other lines of sight see it from another side. How far
// it reaches along the line nobody states.
Eigen::Matrix3d place_covariance(const LineOfSight& sight, double range_m) {
  constexpr double kAlong = 0.2;  // its 1-sigma along the line, over that across
  const Eigen::Matrix<double, 3, 2> across = tangent_basis(sight.direction);
  Eigen::Matrix3d aim = (1.0 - kAlong * kAlong) * across * across.transpose();
  aim.diagonal().array() += kAlong * kAlong;
  Eigen::Matrix3d all = std::pow(sight.aim_sd_rad * range_m, 2) * aim;
  all.diagonal().array() += sight.origin_sd_enu_m.array().square();
  return all;
}

BiasModel BiasModel::evidence_on(const BiasModel& known) {
  BiasModel evidence(known.config_);
  evidence.known_ = &known;
  evidence.common_weight_ = known.common_weight_;
  evidence.common_ratio_ = known.common_ratio_;
  return evidence;
}

void BiasModel::learn(const BiasModel& evidence) {
  for (const auto& [station, seen] : evidence.stations_) stations_.insert_or_assign(station, seen);
  common_weight_ = evidence.common_weight_;
  common_ratio_ = evidence.common_ratio_;
}

const BiasModel::Seen* BiasModel::find(const std::string& station) const {
  const auto found = stations_.find(station);
  if (found != stations_.end()) return &found->second;
  return known_ == nullptr ? nullptr : known_->find(station);
}

BiasModel::Seen& BiasModel::at(const std::string& station) {
  const auto [own, is_new] = stations_.try_emplace(station);
  const Seen* const before = is_new && known_ != nullptr ? known_->find(station) : nullptr;
  if (before != nullptr) own->second = *before;
  return own->second;
}

void BiasModel::observe_noise(const std::string& station, double squared_ratio) {
  constexpr double kMost = 9.0;  // an outlier says nothing about the noise
  Seen& seen = at(station);
  const double decay = 1.0 - 1.0 / config_.colour_memory;
  seen.differences = seen.differences * decay + 1.0;
  seen.white = seen.white * decay + std::min(squared_ratio, kMost);
}

double BiasModel::white_share(const std::string& station) const {
  constexpr double kLeast = 1e-3;
  const Seen* const seen = find(station);
  if (seen == nullptr) return 1.0;
  const double share =
      (config_.noise_weight + seen->white) / (config_.noise_weight + seen->differences);
  return std::clamp(share, kLeast, 1.0);
}

double BiasModel::greatest_white_share(const std::string& station) const {
  const Seen* const seen = find(station);
  const double off = by_chance(config_.noise_weight, seen == nullptr ? 0.0 : seen->differences);
  return std::min(1.0, white_share(station) + off);
}

// A noise with the correlation time T, sampled every dt, averages like that many times fewer white
// samples: 1 + 2 T / dt.
double BiasModel::inflation(const std::string& station, bool declared, double interval_s) const {
  if (!(interval_s > 0.0)) return 1.0;
  const double coloured = 1.0 - greatest_white_share(station);
  const double time_s = declared ? config_.colour_time_s : config_.undeclared_colour_time_s;
  return 1.0 + coloured * 2.0 * time_s / interval_s;
}

void BiasModel::observe_residual(const std::string& station, double ratio) {
  const double stated = ratio * noise_scale(station);
  Seen& seen = at(station);
  const double decay = 1.0 - 1.0 / config_.noise_memory;
  seen.residuals = seen.residuals * decay + 1.0;
  seen.noise = seen.noise * decay + stated;
}

double BiasModel::noise_scale(const std::string& station) const {
  const Seen* const seen = find(station);
  if (seen == nullptr) return 1.0;
  const double scale =
      (config_.noise_weight + seen->noise) / (config_.noise_weight + seen->residuals);
  return std::clamp(scale, config_.least_noise, config_.greatest_noise);
}

void BiasModel::count(const Seen& seen, double sign) {
  if (seen.noise_rad2.minCoeff() <= 0.0) return;
  common_weight_ += sign * (seen.weight + seen.weight_now);
  common_ratio_ += sign * (seen.squared_rad2 + seen.squared_now_rad2) / seen.noise_rad2;
}

void BiasModel::forget(const std::string& station) {
  const auto found = stations_.find(station);
  if (found == stations_.end()) return;
  count(found->second, -1.0);
  stations_.erase(found);
}

Eigen::Array2d BiasModel::learnt(const std::string& station, const Eigen::Array2d& stated_rad2,
                                 const Eigen::Array2d& noise_rad2) const {
  const bool declared = states_anything(stated_rad2);
  const double weight = declared ? config_.stated_weight : config_.undeclared_weight;
  const double least = config_.least_over_noise * config_.least_over_noise;
  const Eigen::Array2d common = (config_.undeclared_weight * least + common_ratio_).max(0.0) /
                                (config_.undeclared_weight + common_weight_);
  const Seen* const seen = find(station);
  // What is stated, or shown beyond it, is either white or slow.
  const double scale = noise_scale(station);
  const double slow = std::max(1.0, scale) - scale * greatest_white_share(station);
  const Eigen::Array2d prior =
      declared ? stated_rad2 : Eigen::Array2d((common + slow) * noise_rad2);
  if (seen == nullptr) return prior;
  const Eigen::Array2d squared = weight * prior + seen->squared_rad2 + seen->squared_now_rad2;
  return (squared / (weight + seen->weight + seen->weight_now)).max(least * noise_rad2);
}

BiasPrior BiasModel::prior(const std::string& station, const LineOfSight& sight, double range_m,
                           bool position_states) const {
  constexpr double kNone = 1e-24;
  BiasPrior prior{.covariance = stated_covariance(sight, range_m),
                  .position_states = position_states};
  const Eigen::Array2d stated = prior.covariance.diagonal();
  const Eigen::Array2d noise = sight.covariance_white.diagonal();
  const bool declared = states_anything(stated);
  const Eigen::Array2d more = (learnt(station, stated, noise) - stated).max(0.0);
  Eigen::Array2d pose = stated;
  if (position_states) {
    pose = sight.covariance_systematic.diagonal().array() - std::pow(sight.aim_sd_rad, 2);
    pose = pose.max(0.0);
  }
  const double least = config_.least_over_noise * config_.least_over_noise;
  const double elevation_rad = sight.direction.elevation_rad;
  prior.covariance.diagonal().array() += more;
  const double share = declared ? kCameraShare : 0.0;
  const Eigen::Array2d all = (pose + more).max(least * noise);
  prior.camera = share * all.minCoeff();
  prior.rotation = rotation_variance(all, prior.camera, elevation_rad);
  Eigen::Array2d stated_pose = Eigen::Array2d::Zero();
  if (declared) stated_pose = pose.max(least * noise);
  const Eigen::Array3d unseen =
      rotation_variance(stated_pose, share * stated_pose.minCoeff(), elevation_rad);
  prior.empirical = (1.0 - unseen / prior.rotation.max(kNone)).max(0.0);
  prior.time_s = declared ? config_.stated_time_s : config_.undeclared_time_s;
  prior.place_time_s = config_.stated_time_s;
  if (position_states) prior.place_m2 = place_covariance(sight, range_m);
  return prior;
}

Eigen::Matrix2d BiasModel::undeclared(const std::string& station, const LineOfSight& sight) const {
  const Eigen::Array2d stated = sight.covariance_systematic.diagonal();
  const Eigen::Array2d all = learnt(station, stated, sight.covariance_white.diagonal());
  return (all - stated).max(0.0).matrix().asDiagonal();
}

void BiasModel::observe(const std::string& station, const LineOfSight& sight,
                        const BiasEstimate& bias, double dt_s, double range_m) {
  const Eigen::Array2d stated = stated_covariance(sight, range_m).diagonal();
  Seen& seen = at(station);
  count(seen, -1.0);
  const double decay = std::exp(-dt_s / config_.memory_s);
  // A bias within one correlation time is one sample, however often it is estimated.
  const double news = std::min(
      1.0, dt_s / (states_anything(stated) ? config_.stated_time_s : config_.undeclared_time_s));
  constexpr double kNone = 1e-24;
  const Eigen::Array2d known = (1.0 - bias.variance / bias.prior.max(kNone)).max(0.0).min(1.0);
  seen.weight_now = known.square();
  seen.squared_now_rad2 = bias.value.square() - known * bias.variance;
  seen.weight = seen.weight * decay + news * seen.weight_now;
  seen.squared_rad2 = seen.squared_rad2 * decay + news * seen.squared_now_rad2;
  // Stations that declare their errors are no evidence for those that do not.
  seen.noise_rad2 = states_anything(stated) ? Eigen::Array2d::Zero()
                                            : Eigen::Array2d(sight.covariance_white.diagonal());
  count(seen, 1.0);
}

void BiasModel::observe_clock(const std::string& station, double value_s, double variance_s2,
                              double prior_s2, double stated_s2, double dt_s) {
  if (!(stated_s2 > 0.0 && config_.clock_weight > 0.0)) return;
  Seen& seen = at(station);
  const double decay = std::exp(-dt_s / config_.memory_s);
  const double news = std::min(1.0, dt_s / config_.clock_time_s);
  const double known = std::clamp(1.0 - variance_s2 / prior_s2, 0.0, 1.0);
  seen.clock_now = known * known;
  seen.clock_squared_now = (value_s * value_s - known * variance_s2) / stated_s2;
  seen.clock_weight = seen.clock_weight * decay + news * seen.clock_now;
  seen.clock_squared = seen.clock_squared * decay + news * seen.clock_squared_now;
}

double BiasModel::clock_scale(const std::string& station) const {
  const Seen* const seen = find(station);
  if (seen == nullptr || !(config_.clock_weight > 0.0)) return 1.0;
  const double squared = config_.clock_weight + seen->clock_squared + seen->clock_squared_now;
  return std::max(1.0, squared / (config_.clock_weight + seen->clock_weight + seen->clock_now));
}

}  // namespace ols::fusion
