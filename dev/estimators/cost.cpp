#include "dev/estimators/cost.h"

#include <time.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <string>
#include <vector>

#include "dev/estimators/bearing_world.h"

namespace ols::bench {
namespace {

using Eigen::Vector3d;

constexpr double kRateHz = 33.0, kDurationS = 5.0, kBornS = 1.0;

// Processor time of this thread: other load on the machine does not count.
double used_s() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

// Groups of stations, each with a target of its own, in the order of time.
std::vector<fusion::BearingMeasurement> groups_of_stations(int groups, int each,
                                                           double place_sd_m) {
  std::mt19937_64 random(9);
  std::vector<fusion::BearingMeasurement> all;
  for (int group = 0; group < groups; ++group) {
    const int row = group / 12;
    const Vector3d centre(4000.0 * (group % 12), 4000.0 * row, 0.0);
    // Every real station states how far its pose may be off.
    WorldConfig world{.stations_enu = circle(each, 300.0),
                      .aims_enu = {},
                      .rate_hz = kRateHz,
                      .bias_sd_rad = 1e-3};
    world.place_sd_m = place_sd_m;
    for (Vector3d& place : world.stations_enu) place += centre;
    const Path path = cruising({centre + Vector3d(0, 0, 100), {8, 3, 0}}, 0.5, kDurationS, random);
    for (fusion::BearingMeasurement& s : measure(world, {path}, kDurationS, random)) {
      s.station.append("g").append(std::to_string(group));
      all.push_back(std::move(s));
    }
  }
  std::ranges::stable_sort(all, {}, &fusion::BearingMeasurement::utime_us);
  return all;
}

// From each bearing to what the fusion makes of it [us].
struct Spans {
  std::vector<double> all, with_targets, with_slews;

  void add(double span_us, const fusion::FusionOutput& output) {
    all.push_back(span_us);
    if (!output.targets.empty()) with_targets.push_back(span_us);
    if (!output.slews.empty()) with_slews.push_back(span_us);
  }
};

double percentile(std::vector<double>& values, double share) {
  if (values.empty()) return 0.0;
  std::ranges::sort(values);
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

// Where the places are off by so much that they matter, each station has states for its own.
void cost_of(int stations, double place_sd_m, Limits& limits) {
  const int each = std::min(8, stations), groups = stations / each;
  fusion::Fusion fusion{fusion::FusionConfig{}};
  Spans born, later;
  double born_s = 0.0, later_s = 0.0;
  for (const fusion::BearingMeasurement& sighting : groups_of_stations(groups, each, place_sd_m)) {
    const bool first = sighting.utime_us - kStartUs <= std::llround(1e6 * kBornS);
    const double begun_s = used_s();
    const fusion::FusionOutput output = fusion.add(sighting);
    const double span_s = used_s() - begun_s;
    (first ? born_s : later_s) += span_s;
    (first ? born : later).add(1e6 * span_s, output);
  }
  std::printf("%5d stations, places to %g m, %3d targets (%g found): %6.2f us CPU a bearing, ",
              stations, place_sd_m, groups, fusion.health().counters.at("tracks_confirmed"),
              1e6 * later_s / static_cast<double>(later.all.size()));
  std::printf("p50 %6.2f us, p99 %7.2f us, longest %7.2f us; ", percentile(later.all, 0.5),
              percentile(later.all, 0.99), percentile(later.all, 1.0));
  std::printf("with targets p50 %7.2f us, p99 %7.2f us; with slews p99 %7.2f us; ",
              percentile(later.with_targets, 0.5), percentile(later.with_targets, 0.99),
              percentile(later.with_slews, 0.99));
  std::printf("of a core at %g Hz %.2f; first second: %.2f of a core, longest %.0f us\n", kRateHz,
              later_s / (kDurationS - kBornS), born_s / kBornS, percentile(born.all, 1.0));
  limits.at_most("p99 of a bearing [ms]", 1e-3 * percentile(later.all, 0.99), 1.0);
  limits.at_most("p99 of those that bring targets [ms]",
                 1e-3 * percentile(later.with_targets, 0.99), 1.0);
  limits.at_most("cores", later_s / (kDurationS - kBornS), 1.0);
}

}  // namespace

void cost(Limits& limits) {
  for (const double place_sd_m : {0.0, 1.0}) {
    for (const int stations : {4, 8, 40, 200, 1000}) cost_of(stations, place_sd_m, limits);
  }
}

}  // namespace ols::bench
