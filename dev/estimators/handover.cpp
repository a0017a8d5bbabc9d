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

double p95(std::vector<double> values) {
  std::ranges::sort(values);
  return values.at(std::min(values.size() - 1, values.size() * 95 / 100));
}

// From the first report of the overview until all stations that turn report it.
double handed_over_s(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  HandoverSiteConfig config;
  config.stations_enu = circle(4, 100.0);
  config.overview_enu = Vector3d(0, 0, 5);
  config.targets = {drone_at(300.0, random)};
  config.handover.mode = fusion::HandoverMode::kAutomatic;
  HandoverSite site(config, seed);
  for (double t = 0.0; t < kPatience_s; t += kStep_s) {
    site.run_until(t);
    if (site.holders(0).size() == config.stations_enu.size()) return t - *site.first_seen_s(0);
  }
  return kPatience_s;
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
  std::vector<double> confirmed, handed_over;
  for (int run = 1; run <= runs; ++run) {
    confirmed.push_back(confirmed_s(static_cast<std::uint64_t>(run)));
    handed_over.push_back(handed_over_s(static_cast<std::uint64_t>(run)));
  }
  std::printf("drone 300 m away, %d runs\n", runs);
  limits.at_most("appearance to confirmed target, four stations that stare, p95 [s]",
                 p95(confirmed), 1.5);
  // Most of it is the search along the overview's line, and turns by up to 180 degrees.
  std::printf("  seen by the overview to held by four stations that turn, p95: %.1f s\n",
              p95(handed_over));
}

}  // namespace ols::bench
