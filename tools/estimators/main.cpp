// ols-bench-estimators: how near the estimators come to their bounds, how honest their covariances
// are, how well targets are kept apart, and what a bearing costs. Prints one table a measure; exits
// with 1 where a measure of accuracy misses its limit.
#include <sys/resource.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "base/command_line.h"
#include "central/fusion.h"
#include "tools/estimators/accuracy.h"
#include "tools/estimators/bearing_world.h"
#include "tools/estimators/peer.h"

namespace {

using Eigen::Vector3d;
using namespace ols;
using namespace ols::bench;

double user_s() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_utime.tv_sec) +
         1e-6 * static_cast<double>(usage.ru_utime.tv_usec);
}

// Groups of up to eight stations, each with a target of its own, in the order of time.
std::vector<Sighting> groups_of_stations(int groups, int each, double rate_hz, double duration_s) {
  std::mt19937_64 random(9);
  std::vector<Sighting> all;
  for (int group = 0; group < groups; ++group) {
    const Vector3d centre(4000.0 * (group % 12), 4000.0 * (group / 12), 0.0);
    WorldConfig world{.stations_enu = circle(each, 300.0), .aims_enu = {}, .rate_hz = rate_hz};
    for (Vector3d& place : world.stations_enu) place += centre;
    const Path path = cruising({centre + Vector3d(0, 0, 100), {8, 3, 0}}, 0.5, duration_s, random);
    for (Sighting& s : measure(world, {path}, duration_s, random)) {
      s.station.append("g").append(std::to_string(group));
      all.push_back(std::move(s));
    }
  }
  std::ranges::stable_sort(all, {}, &Sighting::utime_us);
  return all;
}

void cost() {
  constexpr double kRateHz = 33.0, kDurationS = 5.0, kBornS = 1.0;
  for (const int stations : {4, 8, 40, 200, 1000}) {
    const int each = std::min(8, stations), groups = stations / each;
    Fusion fusion{FusionConfig{}};
    std::vector<double> spans_us;
    const auto bearings = groups_of_stations(groups, each, kRateHz, kDurationS);
    double before_s = user_s(), born_s = 0.0;
    for (const Sighting& sighting : bearings) {
      if (born_s == 0.0 && sighting.utime_us - kStartUs > std::llround(1e6 * kBornS)) {
        born_s = user_s() - before_s;
        before_s = user_s();
        spans_us.clear();
      }
      const auto begun = std::chrono::steady_clock::now();
      fusion.add(sighting);
      const auto span = std::chrono::steady_clock::now() - begun;
      spans_us.push_back(std::chrono::duration<double, std::micro>(span).count());
    }
    const double used_s = user_s() - before_s;
    std::ranges::sort(spans_us);
    std::printf(
        "%5d stations, %3d targets (%g found): %6.2f us CPU a bearing, p50 %6.2f us, p99 %7.2f "
        "us; ",
        stations, groups, fusion.health().counters.at("tracks_confirmed"),
        1e6 * used_s / static_cast<double>(spans_us.size()), spans_us[spans_us.size() / 2],
        spans_us[spans_us.size() * 99 / 100]);
    std::printf("of a core at %g Hz %.2f, %.2f in the first second\n", kRateHz,
                used_s / (kDurationS - kBornS), born_s / kBornS);
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  CLI::App app{"Monte Carlo measures of the estimators on simulated bearings"};
  int runs = 100;
  bool quick = false;
  std::string what = "all";
  app.add_option("--runs", runs, "Monte Carlo runs of each measure")
      ->check(CLI::Range(2, 100000))
      ->capture_default_str();
  app.add_flag("--quick", quick, "the measures of accuracy alone, in a fifth of the runs");
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
  if (quick) runs = std::max(2, runs / 5);
  const bool all = what == "all";
  Limits limits;
  if (all || what == "least-squares") least_squares_bound(20 * runs, limits);
  if (all || what == "filter") filter_bounds(runs, limits);
  if (all || what == "paper") against_paper(std::max(20, runs / 5), limits);
  if (all || what == "targets") several(std::max(2, runs / 5), limits);
  if (what == "cost" || (all && !quick)) cost();
  return limits.missed() == 0 ? 0 : 1;
}
