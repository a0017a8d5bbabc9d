// ols-bench-estimators: how near the estimators come to their bounds, how honest their covariances
// are, how well targets are kept apart, and what a bearing costs. Prints one table a measure.
#include <CLI/CLI.hpp>
#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>

#include "base/command_line.h"
#include "central/fusion.h"
#include "central/least_squares.h"
#include "central/offline_fusion.h"
#include "geometry/angles.h"
#include "tools/estimators/cost.h"
#include "tools/estimators/peer.h"
#include "tools/estimators/posterior_bound.h"
#include "tools/estimators/several_targets.h"

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using namespace ols;
using namespace ols::bench;

struct Sums {
  double squared = 0.0, bound = 0.0;
  int count = 0;
  std::vector<double> nees;  // over 3, of each instant, summed over the runs

  void add(std::size_t instant, const Vector3d& error, double bound_m2, const Matrix3d& P) {
    squared += error.squaredNorm();
    bound += bound_m2;
    ++count;
    if (nees.size() <= instant) nees.resize(instant + 1, 0.0);
    nees[instant] += error.dot(P.ldlt().solve(error)) / 3.0;
  }

  // Over N runs the mean at one instant is a chi-squared variable of 3 N degrees of freedom over
  // that number (Bar-Shalom, Li and Kirubarajan, 2001, section 5.4).
  void print(const char* name, int runs) const {
    const double half = 1.96 * std::sqrt(2.0 / (3.0 * runs));
    double mean = 0.0;
    int inside = 0;
    for (const double sum : nees) {
      mean += sum / runs / static_cast<double>(nees.size());
      inside += std::abs(sum / runs - 1.0) <= half ? 1 : 0;
    }
    std::printf("%-34s RMSE %9.4f m, over bound %6.3f; NEES/3 %6.3f, ", name,
                std::sqrt(squared / count), std::sqrt(squared / bound), mean);
    std::printf("95 %% interval %.3f to %.3f, inside at %.0f %% of %zu instants (%d runs)\n",
                1.0 - half, 1.0 + half, 100.0 * inside / static_cast<double>(nees.size()),
                nees.size(), runs);
  }
};

// One epoch, many geometries: the joint least squares against the Cramer-Rao bound at the truth.
void least_squares_bound(int runs) {
  for (const double scale_m : {30.0, 300.0, 3e3, 50e3}) {
    for (const double systematic : {0.0, 1e-3}) {
      Sums sums;
      std::mt19937_64 random(5);
      std::normal_distribution<double> normal;
      std::uniform_real_distribution<double> uniform;
      for (int run = 0; run < runs; ++run) {
        WorldConfig world{.stations_enu = circle(2 + run % 5, scale_m), .aims_enu = {}};
        world.noise_rad = 3e-4;
        world.bias_sd_rad = systematic;
        const double angle = 2.0 * kPi * uniform(random), far = scale_m * (0.2 + uniform(random));
        const PathPoint there{{far * std::cos(angle), far * std::sin(angle), scale_m * 0.6},
                              Vector3d::Zero()};
        const auto seen = measure(world, {Path(3, there)}, 0.99 / world.rate_hz * 1.02, random);
        std::vector<Ray> rays;
        Matrix3d information = Matrix3d::Zero();
        for (const Sighting& s : seen) {
          rays.push_back({.station = s.station, .sight = s.sight});
          const RayFrame frame = ray_frame(s.sight);
          const double range_m = (site().to_ecef(there.p_enu) - s.sight.origin_ecef).norm();
          const Eigen::Matrix2d R = s.sight.covariance_white + s.sight.covariance_systematic;
          information +=
              frame.tangent * R.inverse() * frame.tangent.transpose() / (range_m * range_m);
        }
        const Estimate estimate = least_squares(rays);
        if (estimate.solution != Solution::kOk) continue;
        const Vector3d e = estimate.position_ecef - site().to_ecef(there.p_enu);
        const Matrix3d bound = information.inverse();
        // Each geometry counts alike, whatever its size.
        const double size = bound.trace();
        sums.add(0, e / std::sqrt(size), 1.0, estimate.covariance_ecef / size);
      }
      char name[80];
      std::snprintf(name, sizeof name, "least squares, %g m, bias %g mrad", scale_m,
                    1e3 * systematic);
      sums.print(name, sums.count);
    }
  }
}

struct BiasCase {
  const char* name;
  double sd_rad, time_s;
};

// The stations state their biases, so that what is known beforehand is true: what a station that
// states nothing may have is guessed, and no bound knows that.
void filter_bound(int runs, const BiasCase& bias) {
  constexpr double kDurationS = 12.0, kWarmS = 4.0, kDisturbance = 0.5;
  Sums sums;
  for (int run = 0; run < runs; ++run) {
    std::mt19937_64 random(static_cast<std::uint64_t>(run) + 1);
    WorldConfig world{.stations_enu = circle(4, 250.0), .aims_enu = {}};
    world.bias_sd_rad = bias.sd_rad;
    world.bias_time_s = bias.time_s;
    const Path path = cruising({{-60, 40, 80}, {9.0, -6.0, 1.0}}, kDisturbance, kDurationS, random);
    const auto bearings = measure(world, {path}, kDurationS, random);
    const auto bound = posterior_bound(world, path, bearings, kDisturbance, 100.0, 100.0);
    OfflineConfig config;
    // The bound is that of the true motion: the filter is told the same.
    config.fusion.keeper.filter.motion.cruise_sd_m_s2 = kDisturbance;
    config.fusion.keeper.filter.motion.cruise_per_speed_s = 0.0;
    std::size_t instant = 0;
    for (const FusedTarget& target : fuse_offline(bearings, config)) {
      const double time_s = 1e-6 * static_cast<double>(target.utime_us - kStartUs);
      if (time_s < kWarmS) continue;
      const auto index = static_cast<std::size_t>(
          std::ranges::lower_bound(bearings, target.utime_us, {}, &Sighting::utime_us) -
          bearings.begin());
      const Vector3d e = target.estimate.position_ecef - site().to_ecef(at(path, time_s).p_enu);
      sums.add(instant++, e, bound[index], target.estimate.covariance_ecef);
    }
  }
  sums.print(bias.name, runs);
}

void filter_bounds(int runs) {
  filter_bound(runs, {"filter, no bias", 1e-6, 1e12});
  filter_bound(runs, {"filter, biases of 1 mrad", 1e-3, 1e12});
  filter_bound(runs, {"filter, biases of 1 mrad, 10 h", 1e-3, 36e3});
  filter_bound(runs, {"filter, biases of 1 mrad, 5 min", 1e-3, 300.0});
}

// A drone that manoeuvres at 200 to 800 m, four stations, against the paper's estimator: live, each
// from the bearings that have come in by then.
void against_paper(int runs) {
  struct Way {
    const char* name;
    const char* estimator;
    int average;
  };
  constexpr double kDurationS = 30.0;
  std::map<std::string, double> squared;
  std::map<std::string, int> counts;
  for (int run = 0; run < runs; ++run) {
    std::mt19937_64 random(static_cast<std::uint64_t>(run) + 1);
    const WorldConfig world{.stations_enu = circle(4, 400.0), .aims_enu = {}, .bias_sd_rad = 0.0};
    const Path path = manoeuvring({{0, 0, 150}, {12, 5, 0}}, 6.0, kDurationS, random);
    const auto bearings = measure(world, {path}, kDurationS, random);
    for (const Way& way : {Way{"filter", "filter", 1}, Way{"paper", "paper", 1},
                           Way{"paper, average of 10", "paper", 10}}) {
      FusionConfig config{.estimator = way.estimator, .paper_targets = 0};
      config.estimators.paper.moving_average = way.average;
      Fusion fusion(config);
      for (const Sighting& sighting : bearings) {
        const FusionOutput output = fusion.add(sighting);
        if (output.targets.empty()) continue;
        const FusedTarget& target = output.targets.front();
        if (target.estimate.solution != Solution::kOk) continue;
        const double time_s = 1e-6 * static_cast<double>(target.utime_us - kStartUs);
        if (time_s < 2.0) continue;
        squared[way.name] +=
            (target.estimate.position_ecef - site().to_ecef(at(path, time_s).p_enu)).squaredNorm();
        ++counts[way.name];
      }
    }
  }
  const double filter = std::sqrt(squared["filter"] / counts["filter"]);
  for (const auto& [name, sum] : squared) {
    const double rms = std::sqrt(sum / counts[name]);
    std::printf("%-34s RMSE %9.4f m  filter / this %6.3f\n", name.c_str(), rms, filter / rms);
  }
}

void several(int runs) {
  double right = 0.0, worst = 1.0, ghost_s = 0.0;
  int switches = 0;
  for (int run = 1; run <= runs; ++run) {
    const IdentityScore score = run_several({}, static_cast<std::uint64_t>(run));
    right += score.by_right_identity / runs;
    worst = std::min(worst, score.by_right_identity);
    ghost_s = std::max(ghost_s, score.longest_ghost_s);
    switches += score.switches;
  }
  std::printf(
      "5 targets, 4 stations: right identity %.4f of target-seconds (worst run %.4f), "
      "longest ghost %.2f s, %d switches in %d runs\n",
      right, worst, ghost_s, switches, runs);
}

}  // namespace

int main(int argc, char** argv) {
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  CLI::App app{"Monte Carlo measures of the estimators on simulated bearings"};
  int runs = 100;
  std::string what = "all";
  app.add_option("--runs", runs, "Monte Carlo runs of each measure")
      ->check(CLI::Range(2, 100000))
      ->capture_default_str();
  app.add_option("measure", what, "all, least-squares, filter, paper, targets or cost")
      ->check(CLI::IsMember({"all", "least-squares", "filter", "paper", "targets", "cost"}));
  std::string peer;
  app.add_option("--write-peer", peer,
                 "instead: a folder for bearings and our filter's fixes, as tools/bench-estimators "
                 "gives them to Stone Soup");
  if (const auto status = parse_command_line(app, argc, argv, "ols-bench-estimators")) {
    return *status;
  }
  if (!peer.empty()) {
    write_peer_runs(peer, runs);
    return 0;
  }
  const bool all = what == "all";
  if (all || what == "least-squares") least_squares_bound(20 * runs);
  if (all || what == "filter") filter_bounds(runs);
  if (all || what == "paper") against_paper(std::max(2, runs / 5));
  if (all || what == "targets") several(std::max(2, runs / 5));
  if (all || what == "cost") print_cost();
  return 0;
}
