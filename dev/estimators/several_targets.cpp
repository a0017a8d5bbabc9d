#include "dev/estimators/several_targets.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "dev/estimators/bearing_world.h"
#include "geometry/angles.h"

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

  void see(const std::vector<fusion::FusedTarget>& targets) {
    const double time_s = 1e-6 * static_cast<double>(targets.front().utime_us - kStartUs);
    std::vector<std::int64_t> nearest(truth_.size(), 0);
    std::vector<double> least(truth_.size(), kNearM);
    for (const fusion::FusedTarget& target : targets) {
      if (target.estimate.solution != fusion::Solution::kOk) continue;
      bool ghost = true;
      for (std::size_t i = 0; i < truth_.size(); ++i) {
        const Vector3d there = site().to_ecef(at(truth_[i], time_s).p_enu);
        const double off_m = (target.estimate.position_ecef - there).norm();
        ghost = ghost && off_m > kNearM;
        if (off_m >= least[i]) continue;
        least[i] = off_m;
        nearest[i] = target.target_id;
      }
      double& since = ghost_since_s_.try_emplace(target.target_id, time_s).first->second;
      if (!ghost) since = time_s;
      longest_ghost_s_ = std::max(longest_ghost_s_, time_s - since);
    }
    if (time_s < kSettledS) return;
    for (std::size_t i = 0; i < truth_.size(); ++i) judge(i, nearest[i], least[i]);
  }

  IdentityScore score() const {
    return {right_ / std::max(1.0, all_), longest_ghost_s_, switches_,
            std::sqrt(squared_ / std::max(1.0, right_))};
  }

 private:
  // The right identity is the first that a target had.
  void judge(std::size_t i, std::int64_t id, double off_m) {
    all_ += 1.0;
    if (id == 0) return;
    if (own_[i] == 0) own_[i] = id;
    if (id == own_[i]) {
      right_ += 1.0;
      squared_ += off_m * off_m;
    }
    if (last_[i] != 0 && id != last_[i]) ++switches_;
    last_[i] = id;
  }

  const std::vector<Path>& truth_;
  std::vector<std::int64_t> own_;
  std::map<std::size_t, std::int64_t> last_;
  std::map<std::int64_t, double> ghost_since_s_;
  double all_ = 0.0, right_ = 0.0, squared_ = 0.0, longest_ghost_s_ = 0.0;
  int switches_ = 0;
};

}  // namespace

IdentityScore run_several(const SeveralTargets& scenario, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const std::vector<Path> truth = crossing(scenario, random);
  WorldConfig world;
  world.stations_enu = circle(scenario.stations, 250.0);
  world.missed = scenario.missed;
  world.false_per_frame = scenario.false_per_frame;
  const auto measurements = measure(world, truth, scenario.duration_s, random);
  fusion::FusionConfig config;
  config.paper_targets = 0;
  fusion::Fusion fusion(config);
  Judge judge(truth);
  for (const fusion::BearingMeasurement& measurement : measurements) {
    const fusion::FusionOutput output = fusion.add(measurement);
    if (!output.targets.empty()) judge.see(output.targets);
  }
  return judge.score();
}

}  // namespace ols::bench
