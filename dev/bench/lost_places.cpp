// ols-bench-lost-places: after how many passes the fusion notices a crane that no model has, and
// how many false alarms it raises without the crane; in simulated time. The trees and houses that
// the scenario's model lacks are taken away, so that only the crane is unknown.
#include <algorithm>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include "dev/bench/program.h"
#include "sim/lockstep/lockstep.h"
#include "sim/scenario/scenario.h"

namespace {

struct Arguments {
  std::string scenario = "sim/scenarios/ridge.toml";
  int seeds = 3, first_seed = 1;
  double seconds = 630.0, without_seconds = 1260.0;
  std::vector<double> crane{-221.0, 279.0, 50.0, 1.5};
};

void declare(CLI::App& app, Arguments& arguments) {
  app.add_option("--scenario", arguments.scenario, "scenario file (TOML)")->capture_default_str();
  app.add_option("--seeds", arguments.seeds, "number of runs, each with the next seed")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  app.add_option("--first-seed", arguments.first_seed)->capture_default_str();
  app.add_option("--seconds", arguments.seconds, "[s] of each run with the crane; 0: none")
      ->capture_default_str();
  app.add_option("--without-seconds", arguments.without_seconds,
                 "[s] of each run without the crane; 0: none")
      ->capture_default_str();
  app.add_option("--crane", arguments.crane, "east, north, height and radius [m]")
      ->delimiter(',')
      ->expected(4)
      ->capture_default_str();
}

// The instants at which the target comes out from behind the crane.
std::vector<double> passes(const ols::sim::World& with, const ols::sim::World& without,
                           std::size_t station, double to_s) {
  constexpr double kStep_s = 0.05, kShortest_s = 0.3;
  std::vector<double> ends_s;
  double since_s = -1.0;
  for (double at_s = 5.0; at_s < to_s; at_s += kStep_s) {
    const auto p_ecef = with.target(0, at_s).p_ecef;
    const bool behind = with.hides(station, p_ecef) && !without.hides(station, p_ecef);
    if (behind && since_s < 0.0) since_s = at_s;
    if (!behind && since_s >= 0.0 && at_s - since_s >= kShortest_s) ends_s.push_back(at_s);
    if (!behind) since_s = -1.0;
  }
  return ends_s;
}

// When each alarm about a place was first raised, by its text.
std::map<std::string, double> alarms_of(const ols::sim::World& world, double seconds) {
  ols::sim::Fidelity fidelity;
  fidelity.pictures = false;
  ols::sim::Lockstep lockstep(world, fidelity);
  std::map<std::string, double> first_s;
  for (double at_s = 1.0; at_s <= seconds; at_s += 1.0) {
    lockstep.run(at_s);
    for (const ols::Alarm& alarm : lockstep.fusion().health().alarms) {
      if (alarm.id == "targets_lost_at_place") first_s.try_emplace(alarm.text, at_s);
    }
  }
  return first_s;
}

void run(const Arguments& arguments, ols::sim::Scenario scenario, int seed) {
  scenario.relief.trees.clear();
  for (ols::sim::House& house : scenario.relief.houses) house.mapped = true;
  const ols::sim::World without(scenario, static_cast<std::uint64_t>(seed));
  scenario.relief.trees.push_back(
      {{arguments.crane[0], arguments.crane[1]}, arguments.crane[2], arguments.crane[3]});
  const ols::sim::World with(scenario, static_cast<std::uint64_t>(seed));
  if (arguments.seconds > 0.0) {
    const auto alarms = alarms_of(with, arguments.seconds);
    for (std::size_t i = 0; i < with.stations().size(); ++i) {
      const auto ends_s = passes(with, without, i, arguments.seconds);
      const std::string& id = with.stations()[i].id;
      std::printf("seed %d %s: %zu passes behind the crane\n", seed, id.c_str(), ends_s.size());
      for (const auto& [words, at_s] : alarms) {
        if (words.find("station " + id + ":") == std::string::npos) continue;
        const auto before = std::ranges::count_if(ends_s, [at = at_s](double s) { return s < at; });
        std::printf("  after %td passes (%.0f s): %s\n", before, at_s, words.c_str());
      }
    }
  }
  if (arguments.without_seconds > 0.0) {
    const auto alarms = alarms_of(without, arguments.without_seconds);
    std::printf("seed %d, without the crane, %.0f s: %zu alarms\n", seed, arguments.without_seconds,
                alarms.size());
    for (const auto& [words, at_s] : alarms) std::printf("  %.0f s: %s\n", at_s, words.c_str());
  }
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("A crane that no model has: after how many passes it is noticed; false alarms.",
               "ols-bench-lost-places");
  Arguments arguments;
  declare(app, arguments);
  return ols::bench::run_program(app, argc, argv, [&] {
    const auto scenario = ols::sim::load_scenario(arguments.scenario);
    for (int i = 0; i < arguments.seeds; ++i) run(arguments, scenario, arguments.first_seed + i);
  });
}
