#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "central/estimators/least_squares.h"
#include "central/offline/offline_fusion.h"
#include "dev/estimators/measures.h"
#include "dev/estimators/posterior_bound.h"
#include "dev/estimators/several_targets.h"
#include "geometry/angles.h"

namespace ols::bench {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

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

  double over_bound() const { return std::sqrt(squared / bound); }
  double mean_nees(int runs) const {
    double mean = 0.0;
    for (const double sum : nees) mean += sum / runs / static_cast<double>(nees.size());
    return mean;
  }
  // Share of the instants at which the mean over the runs is that near to 1.
  double inside(int runs, double half) const {
    const auto near = [&](double sum) { return std::abs(sum / runs - 1.0) <= half; };
    return static_cast<double>(std::ranges::count_if(nees, near)) /
           static_cast<double>(nees.size());
  }
};

// Over N runs the mean at one instant is a chi-squared variable of 3 N degrees of freedom over that
// number (Bar-Shalom, Li and Kirubarajan, 2001, section 5.4): half of its interval of so many
// deviations.
double half_of_interval(int runs, double deviations) {
  return deviations * std::sqrt(2.0 / (3.0 * runs));
}
constexpr double kOf95 = 1.96, kOf99 = 2.576;

struct Geometry {
  double size_m;
  double systematic_rad;
};

// Each geometry counts alike, whatever its size.
void one_epoch(const Geometry& geometry, int run, std::mt19937_64& random, Sums& sums) {
  std::uniform_real_distribution<double> uniform;
  WorldConfig world{.stations_enu = circle(2 + run % 5, geometry.size_m)};
  world.noise_rad = 3e-4;
  world.bias_sd_rad = geometry.systematic_rad;
  const double angle = 2.0 * kPi * uniform(random);
  const double far_m = geometry.size_m * (0.2 + uniform(random));
  const PathPoint there{{far_m * std::cos(angle), far_m * std::sin(angle), geometry.size_m * 0.6},
                        Vector3d::Zero()};
  const Vector3d p_ecef = site().to_ecef(there.p_enu);
  std::vector<fusion::Ray> rays;
  Matrix3d information = Matrix3d::Zero();
  for (const fusion::BearingMeasurement& s :
       measure(world, {Path(3, there)}, 0.99 / world.rate_hz * 1.02, random)) {
    rays.push_back({.station = s.station, .sight = s.sight});
    const fusion::RayFrame frame = fusion::ray_frame(s.sight);
    const double range_m = (p_ecef - s.sight.origin_ecef).norm();
    const Eigen::Matrix2d R = s.sight.covariance_white + s.sight.covariance_systematic;
    information += frame.tangent * R.inverse() * frame.tangent.transpose() / (range_m * range_m);
  }
  const fusion::Estimate estimate = fusion::least_squares(rays);
  if (estimate.solution != fusion::Solution::kOk) return;
  const double size_m2 = information.inverse().trace();
  sums.add(0, (estimate.position_ecef - p_ecef) / std::sqrt(size_m2), 1.0,
           estimate.covariance_ecef / size_m2);
}

struct FilterCase {
  const char* name;
  double tilt_sd_rad, heading_sd_rad, time_s;
  double place_sd_m = 0.0;
  double told_s = fusion::BiasModelConfig{}.stated_time_s;  // what the filter supposes of that
};

constexpr double kFlightS = 12.0, kWarmS = 4.0, kDisturbance = 0.5;

// The bound holds for the true motion: the filter gets the same model.
fusion::OfflineConfig config_of(const FilterCase& filter) {
  fusion::OfflineConfig config;
  config.look_ahead_s = 0.0;  // the bound is that of the bearings so far
  config.fusion.tracks.filter.motion.cruise_sd_m_s2 = kDisturbance;
  config.fusion.tracks.filter.motion.cruise_per_speed_s = 0.0;
  config.fusion.tracks.errors.stated_time_s = filter.told_s;
  return config;
}

// The stations state their biases, so that what is known beforehand is true: what a station that
// states nothing may have is guessed, and no bound knows that.
Sums fly(const FilterCase& filter, int runs) {
  Sums sums;
  for (int run = 0; run < runs; ++run) {
    std::mt19937_64 random(static_cast<std::uint64_t>(run) + 1);
    WorldConfig world{.stations_enu = circle(4, 250.0)};
    world.bias_sd_rad = filter.tilt_sd_rad;
    world.heading_sd_rad = filter.heading_sd_rad;
    world.bias_time_s = filter.time_s;
    world.place_sd_m = filter.place_sd_m;
    const Path path = cruising({{-60, 40, 80}, {9.0, -6.0, 1.0}}, kDisturbance, kFlightS, random);
    const auto bearings = measure(world, {path}, kFlightS, random);
    const auto bound = posterior_bound(world, path, bearings, kDisturbance, 100.0, 100.0);
    std::size_t instant = 0;
    for (const fusion::FusedTarget& target : fusion::fuse_offline(bearings, config_of(filter))) {
      const double time_s = 1e-6 * static_cast<double>(target.utime_us - kStartUs);
      if (time_s < kWarmS) continue;
      const auto index =
          static_cast<std::size_t>(std::ranges::lower_bound(bearings, target.utime_us, {},
                                                            &fusion::BearingMeasurement::utime_us) -
                                   bearings.begin());
      const Vector3d e = target.estimate.position_ecef - site().to_ecef(at(path, time_s).p_enu);
      sums.add(instant++, e, bound[index], target.estimate.covariance_ecef);
    }
  }
  return sums;
}

struct Way {
  const char* name;
  const char* estimator;
  int average;
  bool at_now = false;  // the filter's: for "now", as the estimators without memory publish theirs
};

// Sum of squared errors and their number.
struct Squares {
  double sum = 0.0;
  int count = 0;
  double rms() const { return std::sqrt(sum / count); }
};

Vector3d filtered_at(const fusion::Fusion& fusion, std::int64_t id, std::int64_t utime_us) {
  const auto track = std::ranges::find(fusion.tracks().tracks(), id, &fusion::Track::id);
  return track->filter.at(utime_us).mean.head<3>();
}

void follow(const Way& way, const std::vector<fusion::BearingMeasurement>& bearings,
            const Path& path, Squares& squares) {
  constexpr double kBegunS = 2.0;
  fusion::FusionConfig config{.estimator = way.estimator, .paper_targets = 0};
  config.estimators.paper.moving_average = way.average;
  fusion::Fusion fusion(config);
  for (const fusion::BearingMeasurement& measurement : bearings) {
    const fusion::FusionOutput output = fusion.add(measurement);
    if (output.targets.empty()) continue;
    const fusion::FusedTarget& target = output.targets.front();
    if (target.estimate.solution != fusion::Solution::kOk) continue;
    std::int64_t utime_us = target.utime_us;
    Vector3d p_ecef = target.estimate.position_ecef;
    if (way.at_now) {
      utime_us = fusion.now_us();
      p_ecef = filtered_at(fusion, target.target_id, utime_us);
    }
    const double time_s = 1e-6 * static_cast<double>(utime_us - kStartUs);
    if (time_s < kBegunS) continue;
    squares.sum += (p_ecef - site().to_ecef(at(path, time_s).p_enu)).squaredNorm();
    ++squares.count;
  }
}

}  // namespace

void least_squares_bound(int runs, Limits& limits) {
  for (const double size_m : {30.0, 300.0, 3e3, 50e3}) {
    for (const double systematic : {0.0, 1e-3}) {
      Sums sums;
      std::mt19937_64 random(5);
      for (int run = 0; run < runs; ++run) one_epoch({size_m, systematic}, run, random, sums);
      std::printf("least squares, %g m, bias %g mrad: %d geometries\n", size_m, 1e3 * systematic,
                  sums.count);
      limits.at_most("RMSE over the bound", sums.over_bound(), 1.05);
      limits.within("normalised error squared", sums.mean_nees(sums.count), 0.9, 1.1);
    }
  }
}

void filter_bounds(int runs, Limits& limits) {
  // Seven cases are judged at once, each by its 99 % interval.
  const double instant = half_of_interval(runs, kOf95), half = half_of_interval(runs, kOf99);
  constexpr double kNever = 1e12, kHalfHour = 1800.0, kMinutes = 300.0;
  for (const FilterCase& filter :
       {FilterCase{"no bias", 1e-6, 0.0, kNever},
        FilterCase{"headings off by 1 mrad", 1e-5, 1e-3, kNever},
        FilterCase{"headings off by 5 mrad, tilts by 0.3", 3e-4, 5e-3, kNever},
        FilterCase{"headings off by 1 mrad, places by 1 m", 1e-5, 1e-3, kNever, 1.0},
        FilterCase{"headings and tilts off by 1 mrad", 1e-3, 0.0, kNever},
        FilterCase{"the same, wander within half an hour, declared to the filter", 1e-3, 0.0,
                   kHalfHour, 0.0, kHalfHour},
        FilterCase{"the same, wander within five minutes, declared to the filter", 1e-3, 0.0,
                   kMinutes, 0.0, kMinutes}}) {
    const Sums sums = fly(filter, runs);
    std::printf("filter, %s: RMSE %.4f m, %d runs, NEES inside at %.0f %% of the instants\n",
                filter.name, std::sqrt(sums.squared / sums.count), runs,
                100.0 * sums.inside(runs, instant));
    limits.at_most("RMSE over the bound", sums.over_bound(), 1.2);
    limits.within("normalised error squared", sums.mean_nees(runs), 1.0 - half, 1.0 + half);
  }
}

void against_paper(int runs, Limits& limits) {
  constexpr double kDurationS = 30.0;
  const Way ways[] = {{"filter, as published", "filter", 1},
                      {"filter", "filter", 1, true},  // for the instants of the pairs
                      {"pairs", "paper", 1},
                      {"pairs, average of 10", "paper", 10}};
  std::map<std::string, Squares> squares;
  for (int run = 0; run < runs; ++run) {
    std::mt19937_64 random(static_cast<std::uint64_t>(run) + 1);
    const WorldConfig world{.stations_enu = circle(4, 400.0), .bias_sd_rad = 0.0};
    const Path path = manoeuvring({{0, 0, 150}, {12, 5, 0}}, 6.0, kDurationS, random);
    const auto bearings = measure(world, {path}, kDurationS, random);
    for (const Way& way : ways) follow(way, bearings, path, squares[way.name]);
  }
  for (const Way& way : ways) {
    std::printf("manoeuvring drone, %s: RMSE %.4f m\n", way.name, squares[way.name].rms());
  }
  const double own = squares["filter"].rms();
  limits.at_most("filter over pairs", own / squares["pairs"].rms(), 0.75);
  limits.at_most("filter over their average", own / squares["pairs, average of 10"].rms(), 0.1);
}

void several(int runs, Limits& limits) {
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
      "longest ghost track %.2f s, %d switches in %d runs\n",
      right, worst, ghost_s, switches, runs);
  limits.at_least("target-seconds by the right identity", right, 0.95);
  limits.at_most("longest ghost track [s]", ghost_s, 1.0);
}

void traffic(int runs, Limits& limits) {
  constexpr double kRunS = 60.0;
  for (const int stations : {2, 4}) {
    const SeveralTargets scenario{
        .targets = 10, .stations = stations, .duration_s = kRunS, .tracklets = true};
    double found = 0.0, switches = 0.0, ghosts = 0.0, predicted = 0.0;
    for (int run = 1; run <= runs; ++run) {
      const IdentityScore score = run_several(scenario, static_cast<std::uint64_t>(run));
      found += score.found / runs;
      switches += score.switches;
      ghosts += score.ghosts;
      predicted += score.predicted_ghosts_a_day / runs;
    }
    const double hours = runs * kRunS / 3600.0;
    std::printf(
        "10 targets, %d stations with detectors, %.1f false tracklets an image, %.2f h: found "
        "%.4f, %.1f identity changes an object-hour; false targets a day: %.1f, predicted of two "
        "stations alone %.2f\n",
        stations, scenario.false_per_frame, hours, found, switches / hours / scenario.targets,
        24.0 * ghosts / hours, predicted);
    if (stations == 4) limits.at_least("targets of detectors found", found, 0.95);
  }
}

}  // namespace ols::bench
