#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <random>
#include <vector>

#include "central/offline/offline_fusion.h"
#include "dev/estimators/measures.h"
#include "dev/estimators/recorded.h"
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

}  // namespace

void meteors(int runs, Limits& limits) {
  constexpr double kLeastNees = 0.4;
  for (const double bias_over_noise : {0.2, 0.5}) {
    std::mt19937_64 random(11);
    AgainstLeastSquares filter("filter", false), smoothed("smoothed", true);
    for (int run = 0; run < runs; ++run) {
      const Meteor meteor = meteor_of(bias_over_noise, random);
      const Recording recording{.bearings = bearings_of(meteor, random),
                                .path = meteor.path,
                                .until_s = meteor.duration_s};
      filter.add(recording);
      smoothed.add(recording);
    }
    std::printf("meteors, cameras off by %g of their noise:\n", bias_over_noise);
    filter.judge(limits, kLeastNees);
    smoothed.judge(limits, kLeastNees);
  }
}

}  // namespace ols::bench
