#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "dev/bench/load.h"
#include "dev/estimators/bearing_world.h"
#include "dev/estimators/measures.h"
#include "tools/offline/timing_csv.h"

namespace ols::bench {
namespace {

using Eigen::Vector3d;

constexpr double kDurationS = 5.0, kBornS = 1.0;

// A site, and what its stations see.
struct Load {
  std::string name;
  int groups = 1;   // of stations, far from each other,
  int each = 4;     // stations of each group
  int targets = 1;  // of each group, all of which each of its stations sees
  double rate_hz = 33.0;
  double place_sd_m = 0.0;
};

// In the order of time. The targets of a group fly at different heights.
std::vector<fusion::BearingMeasurement> bearings_of(const Load& load) {
  std::mt19937_64 random(9);
  std::vector<fusion::BearingMeasurement> all;
  for (int group = 0; group < load.groups; ++group) {
    const Vector3d centre(4000.0 * (group % 12), 4000.0 * (group / 12), 0.0);
    // Every real station states how far its pose may be off.
    WorldConfig world{
        .stations_enu = circle(load.each, 300.0), .rate_hz = load.rate_hz, .bias_sd_rad = 1e-3};
    world.place_sd_m = load.place_sd_m;
    for (Vector3d& place : world.stations_enu) place += centre;
    std::vector<Path> paths;
    for (int target = 0; target < load.targets; ++target) {
      const PathPoint start{centre + Vector3d(0, 30.0 * target, 100 + 20.0 * target), {8, 3, 0}};
      paths.push_back(cruising(start, 0.5, kDurationS, random));
    }
    for (fusion::BearingMeasurement& s : measure(world, paths, kDurationS, random)) {
      s.station.append("g").append(std::to_string(group));
      all.push_back(std::move(s));
    }
  }
  std::ranges::stable_sort(all, {}, &fusion::BearingMeasurement::utime_us);
  return all;
}

// From each bearing to what the fusion makes of it [us].
struct Spans {
  std::vector<double> all, with_targets, with_paper, with_slews;

  void add(double span_us, const fusion::FusionOutput& output) {
    all.push_back(span_us);
    if (!output.targets.empty()) with_targets.push_back(span_us);
    if (!output.targets_paper.empty()) with_paper.push_back(span_us);
    if (!output.slews.empty()) with_slews.push_back(span_us);
  }
};

void print(const Load& load, const fusion::Fusion& fusion, const Spans& spans) {
  std::printf("%s, places to %g m (%g tracks confirmed): ", load.name.c_str(), load.place_sd_m,
              fusion.health().counters.at("tracks_confirmed"));
  std::printf("p50 %6.2f us, p99 %7.2f us, longest %7.2f us; ", quantile(spans.all, 0.5),
              quantile(spans.all, 0.99), quantile(spans.all, 1.0));
  std::printf("with targets p50 %7.2f us, p99 %7.2f us; ", quantile(spans.with_targets, 0.5),
              quantile(spans.with_targets, 0.99));
  std::printf("with the paper's p99 %7.2f us; with slews p99 %7.2f us; ",
              quantile(spans.with_paper, 0.99), quantile(spans.with_slews, 0.99));
}

// Where the places are off by so much that they matter, each station has states for its own.
void cost_of(const Load& load, double most_cores, double most_ms, Limits& limits) {
  fusion::Fusion fusion{fusion::FusionConfig{}};
  Spans born, later;
  double born_s = 0.0, later_s = 0.0;
  for (const fusion::BearingMeasurement& measurement : bearings_of(load)) {
    const bool first = measurement.utime_us - kStartUs <= std::llround(1e6 * kBornS);
    const double begun_s = offline::thread_time_s();
    const fusion::FusionOutput output = fusion.add(measurement);
    const double span_s = offline::thread_time_s() - begun_s;
    (first ? born_s : later_s) += span_s;
    (first ? born : later).add(1e6 * span_s, output);
  }
  const double cores = later_s / (kDurationS - kBornS);
  print(load, fusion, later);
  std::printf(
      "%.2f us CPU a bearing, of a core at %g Hz %.2f; first second: %.2f of a core, "
      "longest %.0f us\n",
      1e6 * later_s / static_cast<double>(later.all.size()), load.rate_hz, cores, born_s / kBornS,
      quantile(born.all, 1.0));
  limits.at_most("p99 of a bearing [ms]", 1e-3 * quantile(later.all, 0.99), most_ms);
  limits.at_most("p99 of those that bring targets [ms]", 1e-3 * quantile(later.with_targets, 0.99),
                 most_ms);
  limits.at_most("longest [ms]", 1e-3 * quantile(later.all, 1.0), 20.0);
  limits.at_most("cores", cores, most_cores);
}

}  // namespace

void cost(Limits& limits, std::optional<int> only) {
  const std::vector<int> sites = only ? std::vector{*only} : std::vector{4, 8, 40, 200, 1000};
  for (const double place_sd_m : {0.0, 1.0}) {
    for (const int stations : sites) {
      const int each = std::min(8, stations), groups = stations / each;
      cost_of(
          {.name = std::to_string(stations) + " stations, " + std::to_string(groups) + " targets",
           .groups = groups,
           .each = each,
           .place_sd_m = place_sd_m},
          0.7, 1.0, limits);
    }
  }
  if (only) return;
  // The cost of the paper's estimate grows with the square of the stations of one target.
  for (const int stations : {20, 64, 100}) {
    cost_of({.name = std::to_string(stations) + " stations, all on one target",
             .each = stations,
             .rate_hz = 15.0},
            0.5, 5.0, limits);
  }
  cost_of({.name = "40 stations, all on 8 targets", .each = 40, .targets = 8, .rate_hz = 15.0}, 0.5,
          5.0, limits);
}

}  // namespace ols::bench
