#include "dev/estimators/noise_only.h"

#include <algorithm>
#include <cstdio>
#include <random>

#include "central/offline/offline_fusion.h"
#include "dev/estimators/recorded.h"

namespace ols::bench {
namespace {

constexpr double kFlightS = 12.0, kWarmS = 2.0, kDisturbance = 0.5;

Recording flight(int stations, int run) {
  std::mt19937_64 random(static_cast<std::uint64_t>(run) + 1);
  const WorldConfig world{.stations_enu = circle(stations, 250.0), .aims_enu = {}};
  Recording recording;
  recording.path = cruising({{-60, 40, 80}, {9.0, -6.0, 1.0}}, kDisturbance, kFlightS, random);
  recording.bearings = measure(world, {recording.path}, kFlightS, random);
  fusion::guess_clocks(recording.bearings);
  recording.from_s = kWarmS;
  recording.until_s = kFlightS;
  recording.rate_hz = 10.0;
  return recording;
}

}  // namespace

void noise_only(int runs, Limits& limits) {
  for (const int stations : {2, 3, 4, 12, 100}) {
    AgainstLeastSquares filter("filter", false);
    const int flights = std::max(2, runs * 4 / (4 + stations));  // alike in cost
    for (int run = 0; run < flights; ++run) filter.add(flight(stations, run));
    std::printf("noise alone, %d stations:\n", stations);
    // Errors that are allowed for and not there make it cautious.
    filter.judge(limits, 0.0);
  }
}

}  // namespace ols::bench
