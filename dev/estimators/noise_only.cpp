#include <algorithm>
#include <cstdio>
#include <random>
#include <utility>

#include "central/offline/offline_fusion.h"
#include "dev/estimators/measures.h"
#include "dev/estimators/recorded.h"

namespace ols::bench {
namespace {

constexpr double kFlightS = 12.0, kWarmS = 2.0, kRateHz = 10.0;
const PathPoint kStart{{-60, 40, 80}, {9.0, -6.0, 1.0}};

Recording recorded(int stations, double rate_hz, Path path, std::mt19937_64& random) {
  const WorldConfig world{.stations_enu = circle(stations, 250.0), .rate_hz = rate_hz};
  Recording recording;
  recording.bearings = measure(world, {path}, kFlightS, random);
  fusion::guess_clocks(recording.bearings);
  recording.path = std::move(path);
  recording.from_s = kWarmS;
  recording.until_s = kFlightS;
  recording.rate_hz = kRateHz;
  return recording;
}

Recording drone(int stations, std::mt19937_64& random) {
  constexpr double kAcceleration_m_s2 = 2.0, kBearingsHz = 15.0;
  Path path = manoeuvring(kStart, kAcceleration_m_s2, kFlightS, random);
  return recorded(stations, kBearingsHz, std::move(path), random);
}

// Allowing for manoeuvres that never come costs most where bearings are many.
Recording quiet(int stations, std::mt19937_64& random) {
  constexpr double kDisturbance = 0.5, kBearingsHz = 30.0;
  Path path = cruising(kStart, kDisturbance, kFlightS, random);
  return recorded(stations, kBearingsHz, std::move(path), random);
}

}  // namespace

void noise_only(int runs, Limits& limits) {
  constexpr double kAnyNees = 0.0;  // errors that are allowed for and not there: it is cautious
  for (const int stations : {2, 3, 4, 12, 100}) {
    AgainstLeastSquares filter("filter", false), smoothed("smoothed", true);
    AgainstLeastSquares quiet_filter("filter, hardly any manoeuvre at 30 Hz,", false);
    const int flights = std::max(2, runs * 4 / (4 + stations));  // alike in cost
    for (int run = 0; run < flights; ++run) {
      std::mt19937_64 random(static_cast<std::uint64_t>(run) + 1);
      const Recording recording = drone(stations, random);
      filter.add(recording);
      smoothed.add(recording);
      quiet_filter.add(quiet(stations, random));
    }
    std::printf("noise alone, %d stations:\n", stations);
    filter.judge(limits, kAnyNees);
    smoothed.judge(limits, kAnyNees);
    quiet_filter.print();
  }
}

}  // namespace ols::bench
