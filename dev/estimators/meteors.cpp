#include "dev/estimators/meteors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "central/offline/offline_fusion.h"
#include "dev/estimators/bearing_world.h"
#include "geometry/angles.h"

namespace ols::bench {
namespace {

using Eigen::Vector3d;

struct Meteor {
  WorldConfig world;
  Path path;
  double duration_s = 0.0;
};

// Straight, but for gravity; the drag grows as the air does (Whipple and Jacchia, 1957).
Path falling(const PathPoint& start, double last_drag_m_s2, double duration_s) {
  constexpr double kGravity = 9.6, kEFoldingsOfAir = 3.0;
  Path path = {start};
  const double dt = 1.0 / kPathHz;
  while (static_cast<double>(path.size()) < duration_s * kPathHz + 2.0) {
    PathPoint next = path.back();
    const double share = static_cast<double>(path.size()) * dt / duration_s;
    const double drag = last_drag_m_s2 * std::exp(kEFoldingsOfAir * (share - 1.0));
    next.p_enu += dt * next.v_enu;
    next.v_enu -= dt * (drag * next.v_enu.normalized() + kGravity * Vector3d::UnitZ());
    path.push_back(next);
  }
  return path;
}

// A network of cameras at two sites or more, some side by side, and a meteor that they see.
Meteor meteor_of(double bias_over_noise, std::mt19937_64& random) {
  const auto uniform = [&](double least, double most) {
    return std::uniform_real_distribution<double>(least, most)(random);
  };
  Meteor meteor;
  const auto cameras = std::uniform_int_distribution<std::size_t>(2, 6)(random);
  const auto sites =
      std::uniform_int_distribution<std::size_t>(2, std::min<std::size_t>(cameras, 3))(random);
  const double from_rad = uniform(0.0, 2.0 * kPi), apart_m = uniform(20e3, 60e3);
  for (std::size_t i = 0; i < cameras; ++i) {
    const double angle =
        from_rad + 2.0 * kPi * static_cast<double>(i % sites) / static_cast<double>(sites);
    const double beside_m = 10.0 * static_cast<double>(i / sites);
    meteor.world.stations_enu.emplace_back(apart_m * std::cos(angle) + beside_m,
                                           apart_m * std::sin(angle), 0.0);
  }
  meteor.world.rate_hz = uniform(25.0, 60.0);
  meteor.world.noise_rad = radians(uniform(0.003, 0.02));
  meteor.world.bias_sd_rad = bias_over_noise * meteor.world.noise_rad;
  meteor.world.bias_stated = false;
  const double speed_m_s = uniform(10e3, 70e3), dip_rad = radians(uniform(20.0, 70.0));
  const double high_m = uniform(85e3, 120e3), low_m = uniform(50e3, 80e3);
  const double most_s = (high_m - low_m) / (speed_m_s * std::sin(dip_rad));
  meteor.duration_s = std::min(most_s, std::exp(uniform(std::log(0.3), std::log(5.0))));
  const double to_rad = uniform(0.0, 2.0 * kPi), aside_rad = uniform(0.0, 2.0 * kPi);
  const double aside_m = uniform(20e3, 120e3);
  const Vector3d along(std::cos(dip_rad) * std::sin(to_rad), std::cos(dip_rad) * std::cos(to_rad),
                       -std::sin(dip_rad));
  const PathPoint start{{aside_m * std::sin(aside_rad), aside_m * std::cos(aside_rad), high_m},
                        speed_m_s * along};
  // From hardly any to a tenth of the speed in the last second.
  const double drag = speed_m_s * std::exp(uniform(std::log(1e-3), std::log(0.1)));
  meteor.path = falling(start, drag, meteor.duration_s);
  return meteor;
}

// Each camera's clock is off by what moves its bearings by half of their noise.
std::vector<fusion::BearingMeasurement> bearings_of(const Meteor& meteor, std::mt19937_64& random) {
  auto bearings = measure(meteor.world, {meteor.path}, meteor.duration_s, random);
  fusion::guess_clocks(bearings);
  std::map<std::string, std::int64_t> off_us;
  std::normal_distribution<double> normal;
  for (fusion::BearingMeasurement& bearing : bearings) {
    const auto [own, is_new] = off_us.try_emplace(bearing.station, 0);
    if (is_new) own->second = std::llround(1e6 * bearing.clock_sd_s * normal(random));
    bearing.utime_us += own->second;
  }
  std::ranges::stable_sort(bearings, {}, &fusion::BearingMeasurement::utime_us);
  fusion::guess_clocks(bearings);
  return bearings;
}

// Of one recording: median, RMS and 95 % of the error, and the normalised error squared of an axis.
struct Score {
  std::array<double, 3> size_m{};
  double nees = 0.0;
};

struct Error {
  double size_m = 0.0, nees = 0.0;
};
using Errors = std::map<std::int64_t, Error>;  // by instant

Errors errors_of(const std::vector<fusion::BearingMeasurement>& bearings, const Meteor& meteor,
                 const char* estimator, bool smooth) {
  fusion::OfflineConfig config;
  config.estimator = estimator;
  config.smooth = smooth;
  config.fusion.tracks.errors.clock_weight = 1.0;
  Errors errors;
  for (const fusion::FusedTarget& target : fusion::fuse_offline(bearings, config)) {
    const double time_s = static_cast<double>(target.utime_us - kStartUs) * 1e-6;
    if (time_s < 0.0 || time_s > meteor.duration_s) continue;
    const Vector3d off =
        target.estimate.position_ecef - site().to_ecef(at(meteor.path, time_s).p_enu);
    const Eigen::Matrix3d R = R_ecef_enu(target.estimate.position_ecef);
    const Eigen::Array3d variance =
        (R.transpose() * target.estimate.covariance_ecef * R).diagonal();
    const Eigen::Array3d off_enu = R.transpose() * off;
    errors[target.utime_us] = {off.norm(), (off_enu.square() / variance).mean()};
  }
  return errors;
}

Score score_of(const Errors& errors, const std::vector<std::int64_t>& instants) {
  std::vector<double> sizes;
  Score score;
  double squared = 0.0;
  const auto n = static_cast<double>(instants.size());
  for (const std::int64_t instant : instants) {
    const Error& error = errors.at(instant);
    sizes.push_back(error.size_m);
    squared += error.size_m * error.size_m / n;
    score.nees += error.nees / n;
  }
  std::ranges::sort(sizes);
  const auto rank = [&](double share) {
    return sizes[static_cast<std::size_t>(share * static_cast<double>(sizes.size() - 1))];
  };
  score.size_m = {rank(0.5), std::sqrt(squared), rank(0.95)};
  return score;
}

double median_of(std::vector<double> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

// Over all recordings, of one estimator: its error over that of least squares, and its honesty.
struct Summary {
  std::array<std::vector<double>, 3> log_ratio;
  std::vector<double> nees;

  void add(const Score& own, const Score& reference) {
    for (std::size_t i = 0; i < 3; ++i)
      log_ratio[i].push_back(std::log(own.size_m[i] / reference.size_m[i]));
    nees.push_back(own.nees);
  }
  double ratio(std::size_t i) const {
    double sum = 0.0;
    for (const double value : log_ratio[i]) sum += value;
    return std::exp(sum / static_cast<double>(log_ratio[i].size()));
  }
  double worse(std::size_t i) const {
    const auto count = std::ranges::count_if(log_ratio[i], [](double x) { return x > 0.02; });
    return static_cast<double>(count) / static_cast<double>(log_ratio[i].size());
  }
};

void judge(const std::string& name, const Summary& own, Limits& limits) {
  std::vector<double> nees = own.nees;
  std::ranges::sort(nees);
  std::printf(
      "  %s over least squares, %zu recordings: median %.3f, RMS %.3f, p95 %.3f (worse in "
      "%.0f, %.0f, %.0f %%); NEES of an axis 10 %% %.2f, median %.2f, 90 %% %.2f\n",
      name.c_str(), nees.size(), own.ratio(0), own.ratio(1), own.ratio(2), 100.0 * own.worse(0),
      100.0 * own.worse(1), 100.0 * own.worse(2), nees[nees.size() / 10], median_of(nees),
      nees[nees.size() * 9 / 10]);
  const char* const sizes[] = {"median", "RMS", "95 %"};
  for (std::size_t i = 0; i < 3; ++i)
    limits.at_most(std::string(sizes[i]) + " over that of least squares", own.ratio(i), 1.02);
  limits.within("normalised error squared of an axis", median_of(nees), 0.4, 2.5);
}

}  // namespace

void meteors(int runs, Limits& limits) {
  for (const double bias_over_noise : {0.2, 0.5}) {
    std::mt19937_64 random(11);
    Summary filter, smoothed;
    for (int run = 0; run < runs; ++run) {
      const Meteor meteor = meteor_of(bias_over_noise, random);
      const auto bearings = bearings_of(meteor, random);
      const Errors reference = errors_of(bearings, meteor, "least-squares", false);
      const Errors live = errors_of(bearings, meteor, "filter", false);
      const Errors smooth = errors_of(bearings, meteor, "filter", true);
      std::vector<std::int64_t> instants;
      for (const auto& [instant, error] : reference) {
        if (live.contains(instant) && smooth.contains(instant)) instants.push_back(instant);
      }
      if (instants.size() < 10) continue;
      const Score least_squares = score_of(reference, instants);
      filter.add(score_of(live, instants), least_squares);
      smoothed.add(score_of(smooth, instants), least_squares);
    }
    std::printf("meteors, cameras off by %g of their noise:\n", bias_over_noise);
    judge("filter", filter, limits);
    judge("smoothed", smoothed, limits);
  }
}

}  // namespace ols::bench
