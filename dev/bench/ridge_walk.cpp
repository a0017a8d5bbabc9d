// ols-bench-ridge-walk: a drone that flies behind hills and houses and comes out again, in
// simulated time: what the stations say meanwhile, how soon they find it again, and how good the
// predicted exits are; with a model of the land and without. Each seed has its own errors and its
// own model.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "dev/bench/program.h"
#include "sim/lockstep/hidden_spans.h"
#include "sim/scenario/scenario.h"

namespace {

using ols::sim::HiddenSpan;
using ols::sim::JudgedExit;

struct Arguments {
  std::string scenario = "sim/scenarios/ridge.toml";
  int seeds = 20, first_seed = 1;
  double seconds = 110.0;
  std::vector<std::string> stations;
  bool verbose = false;
};

void declare(CLI::App& app, Arguments& arguments) {
  app.add_option("--scenario", arguments.scenario, "scenario file (TOML)")->capture_default_str();
  app.add_option("--seeds", arguments.seeds, "number of runs, each with the next seed")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  app.add_option("--first-seed", arguments.first_seed)->capture_default_str();
  app.add_option("--seconds", arguments.seconds, "[s] of each run")
      ->check(CLI::Range(10.0, 3600.0))
      ->capture_default_str();
  app.add_option("--stations", arguments.stations, "only these; without: all")->delimiter(',');
  app.add_flag("--each", arguments.verbose, "one line for each time that it was hidden");
}

std::vector<HiddenSpan> run(const Arguments& arguments, const ols::sim::Scenario& scenario,
                            int seed, bool land_model) {
  const ols::sim::World world(scenario, static_cast<std::uint64_t>(seed));
  ols::sim::Fidelity fidelity;
  fidelity.pictures = false;
  fidelity.land_model = land_model;
  ols::sim::Lockstep lockstep(world, fidelity);
  lockstep.run(arguments.seconds);
  return hidden_spans(world, lockstep.result());
}

void print(int seed, const HiddenSpan& span) {
  std::printf("%4d %-8s %6.2f to %6.2f  %s lost %2d slewed %2d hidden %2d of %2d  found %5.2f",
              seed, span.station.c_str(), span.from_s, span.to_s,
              span.predicted ? "predicted    " : "not predicted", span.lost, span.slewed,
              span.hidden, span.frames, span.found_s.value_or(-1.0));
  for (const auto* exit : {&span.first, &span.last}) {
    if (!*exit) continue;
    std::printf("  | %4.1f s ahead: %+5.2f +- %4.2f s, place %5.2f", (*exit)->ahead_s,
                (*exit)->error_s, (*exit)->sd_s, (*exit)->place_nees);
  }
  std::printf("\n");
}

void print_exits(const char* when, const std::vector<HiddenSpan>& spans,
                 std::optional<JudgedExit> HiddenSpan::*which) {
  double time = 0.0, place = 0.0, ahead_s = 0.0;
  std::vector<double> errors_s;
  for (const HiddenSpan& span : spans) {
    const auto& exit = span.*which;
    if (!exit) continue;
    time += exit->time_nees();
    place += exit->place_nees;
    ahead_s += exit->ahead_s;
    errors_s.push_back(std::abs(exit->error_s));
  }
  if (errors_s.empty()) return;
  const auto count = static_cast<double>(errors_s.size());
  std::ranges::sort(errors_s);
  std::printf(
      "  exits predicted %s, %.1f s ahead: %zu; error of the time: median %.2f s; NEES of "
      "time %.2f, of place %.2f\n",
      when, ahead_s / count, errors_s.size(), errors_s[errors_s.size() / 2], time / count,
      place / count);
}

void summarise(const std::vector<HiddenSpan>& spans) {
  constexpr double kSoon_s = 0.3;
  int predicted = 0, soon = 0, never = 0, frames = 0, lost = 0, slewed = 0, lost_predicted = 0;
  for (const HiddenSpan& span : spans) {
    predicted += span.predicted ? 1 : 0;
    soon += span.found_s && *span.found_s <= kSoon_s ? 1 : 0;
    never += span.found_s ? 0 : 1;
    frames += span.frames;
    lost += span.lost;
    slewed += span.slewed;
    if (span.predicted) lost_predicted += span.lost + span.slewed;
  }
  const auto count = static_cast<double>(std::max<std::size_t>(1, spans.size()));
  std::printf("  hidden %zu times, as predicted %d\n", spans.size(), predicted);
  std::printf("  of %d frames meanwhile: lost %d, searching %d; of those hidden as predicted %d\n",
              frames, lost, slewed, lost_predicted);
  std::printf("  found again within %.1f s: %.1f %%; never: %d\n", kSoon_s, 100.0 * soon / count,
              never);
  print_exits("at the beginning", spans, &HiddenSpan::first);
  print_exits("at the end", spans, &HiddenSpan::last);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("A drone behind hills and houses: what stations say, and when they find it again.",
               "ols-bench-ridge-walk");
  Arguments arguments;
  declare(app, arguments);
  return ols::bench::run_program(app, argc, argv, [&] {
    auto scenario = ols::sim::load_scenario(arguments.scenario);
    if (!arguments.stations.empty()) {
      std::erase_if(scenario.stations, [&](const ols::sim::StationScenario& station) {
        return std::ranges::count(arguments.stations, station.id) == 0;
      });
    }
    for (const bool land_model : {true, false}) {
      std::vector<HiddenSpan> all;
      for (int i = 0; i < arguments.seeds; ++i) {
        const int seed = arguments.first_seed + i;
        const auto spans = run(arguments, scenario, seed, land_model);
        all.insert(all.end(), spans.begin(), spans.end());
        for (const HiddenSpan& span : spans) {
          if (arguments.verbose) print(seed, span);
        }
      }
      std::printf("%s a model of the land\n", land_model ? "with" : "without");
      summarise(all);
      std::fflush(stdout);
    }
  });
}
