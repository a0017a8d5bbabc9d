// How long a target takes from its appearance to a position, and to all stations that turn.
#include <algorithm>
#include <cstdio>
#include <random>

#include "dev/estimators/bearing_world.h"
#include "dev/estimators/handover_site.h"
#include "dev/estimators/measures.h"
#include "geometry/angles.h"

namespace ols::bench {
namespace {

using Eigen::Vector3d;

constexpr double kPatience_s = 20.0, kStep_s = 0.05;

FlyingTarget drone_at(double range_m, std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform;
  const double where = 2.0 * kPi * uniform(random), course = 2.0 * kPi * uniform(random);
  return {.p_enu = {range_m * std::sin(where), range_m * std::cos(where),
                    40.0 + 60.0 * uniform(random)},
          .v_enu = 12.0 * Vector3d(std::sin(course), std::cos(course), 0.0),
          .appears_s = 1.0 + uniform(random)};
}

double quantile(std::vector<double> values, std::size_t percent) {
  std::ranges::sort(values);
  return values.at(std::min(values.size() - 1, values.size() * percent / 100));
}

// [s] from the first report of the overview: until a station that turns reports it, too, until it
// has a position, and until all report it. `turn_s`: what the station that has to turn farthest
// needs for that alone.
struct Parts {
  double first_s = kPatience_s, located_s = kPatience_s, all_s = kPatience_s, turn_s = 0.0;
};

Parts handed_over(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  HandoverSiteConfig config;
  config.stations_enu = circle(4, 100.0);
  config.overview_enu = Vector3d(0, 0, 5);
  config.targets = {drone_at(300.0, random)};
  config.handover.mode = fusion::HandoverMode::kAutomatic;
  HandoverSite site(config, seed);
  Parts parts;
  for (double t = 0.0; t < kPatience_s; t += kStep_s) {
    site.run_until(t);
    const auto seen_s = site.first_seen_s(0);
    if (!seen_s) continue;
    if (parts.turn_s == 0.0) parts.turn_s = site.farthest_turn_s(0);
    const std::size_t holders = site.holders(0).size();
    if (holders > 0) parts.first_s = std::min(parts.first_s, t - *seen_s);
    if (site.found(0) != 0) parts.located_s = std::min(parts.located_s, t - *seen_s);
    if (holders < config.stations_enu.size()) continue;
    parts.all_s = t - *seen_s;
    break;
  }
  return parts;
}

// From its appearance to a confirmed target, before four stations that stare.
double confirmed_s(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  HandoverSiteConfig config;
  config.stations_enu = circle(4, 100.0);
  config.stations_turn = false;
  config.confirm_s = 0.3;  // of the detector: docs/detection.md
  config.targets = {drone_at(300.0, random)};
  HandoverSite site(config, seed);
  for (double t = 0.0; t < kPatience_s; t += kStep_s) {
    site.run_until(t);
    if (site.found(0) != 0) return t - config.targets[0].appears_s;
  }
  return kPatience_s;
}

}  // namespace

void handover(int runs, Limits& limits) {
  std::vector<double> confirmed, first, located, all, turn, beyond;
  for (int run = 1; run <= runs; ++run) {
    confirmed.push_back(confirmed_s(static_cast<std::uint64_t>(run)));
    const Parts parts = handed_over(static_cast<std::uint64_t>(run));
    first.push_back(parts.first_s);
    located.push_back(parts.located_s);
    all.push_back(parts.all_s);
    turn.push_back(parts.turn_s);
    beyond.push_back(parts.all_s - parts.turn_s);
  }
  std::printf("drone 300 m away, %d runs\n", runs);
  limits.at_most("appearance to confirmed target, four stations that stare, p95 [s]",
                 quantile(confirmed, 95), 1.5);
  const auto show = [](const char* what, const std::vector<double>& values) {
    std::printf("  %-52s median %4.1f s, p95 %4.1f s\n", what, quantile(values, 50),
                quantile(values, 95));
  };
  std::printf("seen by the overview until\n");
  show("a station that turns has it, too", first);
  show("it has a position", located);
  show("all four stations that turn have it", all);
  show("farthest turn alone, by up to 180 degrees", turn);
  show("beyond that turn", beyond);
}

}  // namespace ols::bench
