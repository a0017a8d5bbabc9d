#include "dev/estimators/several_targets.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "dev/estimators/bearing_world.h"
#include "geometry/angles.h"
#include "geometry/assignment.h"

namespace ols::bench {
namespace {

using Eigen::Vector3d;

constexpr double kSettledS = 2.0;  // not judged earlier: confirming a track takes time
constexpr double kNearM = 3.0;     // further from every target: a ghost track

// They fly to and fro through the middle, at heights of their own, and meet there.
std::vector<Path> crossing(const SeveralTargets& scenario, std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform;
  std::vector<Path> paths;
  for (int i = 0; i < scenario.targets; ++i) {
    const double angle = 2.0 * kPi * (i + uniform(random)) / scenario.targets;
    const double period_s = 12.0 + 8.0 * uniform(random), reach_m = 50.0 + 40.0 * uniform(random);
    const double phase = 2.0 * kPi * uniform(random), height_m = 60.0 + 6.0 * i;
    const double w = 2.0 * kPi / period_s;
    Path path;
    for (int k = 0; k < static_cast<int>(scenario.duration_s * kPathHz) + 2; ++k) {
      const double t = k / kPathHz;
      const double along = reach_m * std::sin(w * t + phase);
      const double across = 15.0 * std::sin(0.7 * w * t + 2.0 * phase);
      path.push_back({Vector3d(along * std::cos(angle) - across * std::sin(angle),
                               along * std::sin(angle) + across * std::cos(angle),
                               height_m + 3.0 * std::sin(0.5 * w * t)),
                      Vector3d::Zero()});
    }
    paths.push_back(std::move(path));
  }
  return paths;
}

class Judge {
 public:
  explicit Judge(const std::vector<Path>& truth) : truth_(truth), own_(truth.size(), 0) {}

  // The targets of an epoch come with several bearings.
  void take(const fusion::FusedTarget& target) {
    if (!epoch_.empty() && epoch_.front().utime_us != target.utime_us) {
      see(epoch_);
      epoch_.clear();
    }
    epoch_.push_back(target);
  }

  IdentityScore score() const {
    return {right_ / std::max(1.0, all_),
            longest_ghost_s_,
            switches_,
            std::sqrt(squared_ / std::max(1.0, right_)),
            found_ / std::max(1.0, all_),
            static_cast<int>(std::ranges::count(ever_right_, false,
                                                &decltype(ever_right_)::value_type::second))};
  }

 private:
  void see(const std::vector<fusion::FusedTarget>& targets) {
    const double time_s = 1e-6 * static_cast<double>(targets.front().utime_us - kStartUs);
    const Eigen::MatrixXd off_m = distances(targets, time_s);
    for (std::size_t k = 0; k < targets.size(); ++k) {
      if (targets[k].estimate.solution != fusion::Solution::kOk) continue;
      const bool ghost = (off_m.col(static_cast<Eigen::Index>(k)).array() > kNearM).all();
      bool& ever_right = ever_right_.try_emplace(targets[k].target_id, false).first->second;
      ever_right = ever_right || !ghost;
      double& since = ghost_since_s_.try_emplace(targets[k].target_id, time_s).first->second;
      if (!ghost) since = time_s;
      longest_ghost_s_ = std::max(longest_ghost_s_, time_s - since);
    }
    if (time_s < kSettledS) return;
    const std::vector<int> target = assign(off_m, kNearM);
    for (std::size_t i = 0; i < truth_.size(); ++i) {
      const auto k = static_cast<std::size_t>(target[i]);
      if (target[i] < 0) {
        all_ += 1.0;
      } else {
        judge(i, targets[k].target_id, off_m(static_cast<Eigen::Index>(i), target[i]));
      }
    }
  }

  // Of each true object (row) from each target; without a position infinite.
  Eigen::MatrixXd distances(const std::vector<fusion::FusedTarget>& targets, double time_s) const {
    Eigen::MatrixXd off_m = Eigen::MatrixXd::Constant(std::ssize(truth_), std::ssize(targets),
                                                      std::numeric_limits<double>::infinity());
    for (Eigen::Index i = 0; i < off_m.rows(); ++i) {
      const Vector3d there = site().to_ecef(at(truth_[static_cast<std::size_t>(i)], time_s).p_enu);
      for (Eigen::Index k = 0; k < off_m.cols(); ++k) {
        const fusion::Estimate& estimate = targets[static_cast<std::size_t>(k)].estimate;
        if (estimate.solution == fusion::Solution::kOk)
          off_m(i, k) = (estimate.position_ecef - there).norm();
      }
    }
    return off_m;
  }

  // The right identity is the first that a target had.
  void judge(std::size_t i, std::int64_t id, double off_m) {
    all_ += 1.0;
    found_ += 1.0;
    if (own_[i] == 0) own_[i] = id;
    if (id == own_[i]) {
      right_ += 1.0;
      squared_ += off_m * off_m;
    }
    if (last_[i] != 0 && id != last_[i]) ++switches_;
    last_[i] = id;
  }

  const std::vector<Path>& truth_;
  std::vector<fusion::FusedTarget> epoch_;
  std::vector<std::int64_t> own_;
  std::map<std::size_t, std::int64_t> last_;
  std::map<std::int64_t, double> ghost_since_s_;
  std::map<std::int64_t, bool> ever_right_;
  double all_ = 0.0, found_ = 0.0, right_ = 0.0, squared_ = 0.0, longest_ghost_s_ = 0.0;
  int switches_ = 0;
};

constexpr std::int64_t kStatusUs = 500'000;

void know_views(const WorldConfig& world, fusion::Fusion& fusion) {
  for (std::size_t i = 0; i < world.stations_enu.size(); ++i) {
    fusion::StationTraits traits;
    traits.camera_ecef = site().to_ecef(world.stations_enu[i]);
    traits.field_of_view_rad = 2.0 * world.view_rad;
    traits.axis = aim_of(world, i);
    traits.commandable = false;
    fusion.know_station(name_of_station(i), traits);
  }
}

}  // namespace

IdentityScore run_several(const SeveralTargets& scenario, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const std::vector<Path> truth = crossing(scenario, random);
  WorldConfig world;
  world.stations_enu = circle(scenario.stations, 250.0);
  world.missed = scenario.missed;
  world.false_per_frame = scenario.false_per_frame;
  world.tracklets = scenario.tracklets;
  if (scenario.tracklets) world.rate_hz = 15.0;
  const auto measurements = measure(world, truth, scenario.duration_s, random);
  fusion::FusionConfig config;
  config.paper_targets = 0;
  fusion::Fusion fusion(config);
  Judge judge(truth);
  std::int64_t known_us = 0;
  for (const fusion::BearingMeasurement& measurement : measurements) {
    if (scenario.tracklets && measurement.utime_us - known_us > kStatusUs) {
      known_us = measurement.utime_us;
      know_views(world, fusion);
    }
    const fusion::FusionOutput output = fusion.add(measurement);
    for (const fusion::FusedTarget& target : output.targets) judge.take(target);
  }
  IdentityScore score = judge.score();
  score.predicted_ghosts_a_day = fusion.tracks().predicted_ghosts_a_day();
  return score;
}

}  // namespace ols::bench
