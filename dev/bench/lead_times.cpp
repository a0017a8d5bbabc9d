// ols-bench-lead-times: how long after a click in the overview station's picture, or after an
// operator has allowed a cue from outside, the other stations see and follow the target, with
// pictures and in simulated time: the same figures on any computer. Each seed has its own errors,
// and begins at another place of the flight.
#include <algorithm>
#include <cstdio>
#include <opencv2/core/utility.hpp>
#include <optional>
#include <string>
#include <vector>

#include "dev/bench/program.h"
#include "sim/lockstep/outside_cue.h"
#include "sim/lockstep/overview_click.h"
#include "sim/lockstep/unattended.h"

namespace {

struct Arguments {
  std::string scenario = "sim/scenarios/overview.toml";
  std::vector<std::uint64_t> seeds = {1, 2, 3, 4, 5, 6};
  double apart_s = 11.0;
  double patience_s = 20.0;
  bool places_only = false;
  double seconds = 60.0;
  ols::sim::OutsideCueConfig cue;
};

void declare(CLI::App& app, Arguments& arguments) {
  app.add_option("--scenario", arguments.scenario, "scenario file (TOML)")->capture_default_str();
  app.add_option("--seeds", arguments.seeds, "of the runs")->delimiter(',')->capture_default_str();
  app.add_option("--apart", arguments.apart_s,
                 "[s] of the flight between two seeds, so that each has another place")
      ->check(CLI::Range(0.0, 3600.0))
      ->capture_default_str();
  app.add_option("--patience", arguments.patience_s,
                 "[s] after the click or the word, then a run ends")
      ->check(CLI::Range(1.0, 600.0))
      ->capture_default_str();
  app.require_subcommand(1);
  app.fallthrough();
  app.add_subcommand("look", "a click in the overview station's picture");
  auto* alone =
      app.add_subcommand("unattended",
                         "nothing: a site without any person finds what flies (--scenario "
                         "sim/scenarios/unattended.toml)");
  alone->add_option("--seconds", arguments.seconds, "[s] of the scenario")
      ->check(CLI::Range(1.0, 3600.0))
      ->capture_default_str();
  auto* cue = app.add_subcommand("cue", "an operator's word on a cue from outside");
  cue->add_option("--sd", arguments.cue.sd_m, "[m] 1-sigma of the cue's places, each axis")
      ->check(CLI::Range(0.1, 1000.0))
      ->capture_default_str();
  cue->add_option("--report", arguments.cue.report_s, "[s] between two places of the source")
      ->check(CLI::Range(0.1, 60.0))
      ->capture_default_str();
  cue->add_option("--delay", arguments.cue.delay_s, "[s] by which they are late")
      ->check(CLI::Range(0.0, 9.0))
      ->capture_default_str();
  cue->add_flag("--places-only", arguments.places_only, "the source says no velocity");
}

std::optional<double> first(const std::map<std::string, double>& times) {
  if (times.empty()) return std::nullopt;
  return std::ranges::min_element(times, {}, [](const auto& one) { return one.second; })->second;
}

std::optional<double> held_by(const ols::sim::LeadTimes& times, std::size_t stations) {
  std::vector<double> since;
  for (const auto& [id, after_s] : times.follows) since.push_back(after_s);
  std::ranges::sort(since);
  return since.size() < stations ? std::nullopt : std::optional(since.at(stations - 1));
}

std::string text(const std::optional<double>& seconds) {
  if (!seconds) return "never";
  char text[16];
  std::snprintf(text, sizeof text, "%.2f", *seconds);
  return text;
}

ols::sim::LeadTimes lead_times(const Arguments& arguments, const ols::sim::Scenario& scenario,
                               std::uint64_t seed, bool look) {
  const double elapsed_s = static_cast<double>(seed) * arguments.apart_s - arguments.apart_s;
  if (look) {
    return click_in_overview(scenario, seed,
                             {.elapsed_s = elapsed_s, .patience_s = arguments.patience_s});
  }
  auto cue = arguments.cue;
  cue.elapsed_s = elapsed_s;
  cue.with_velocity = !arguments.places_only;
  cue.patience_s = arguments.patience_s;
  return cue_from_outside(scenario, seed, cue);
}

void run(const Arguments& arguments, bool look) {
  constexpr double kWanted_s = 5.0;
  cv::setNumThreads(1);
  const auto scenario = ols::sim::load_scenario(arguments.scenario);
  std::printf("[s after %s]\n", look ? "the click" : "the operator's word");
  std::printf("seed  first in picture  first follows  position  all follow\n");
  std::size_t one = 0;
  std::size_t all = 0;
  for (const std::uint64_t seed : arguments.seeds) {
    const auto times = lead_times(arguments, scenario, seed, look);
    const auto follows = first(times.follows);
    std::optional<double> last;
    if (times.complete()) last = 0.0;
    for (const auto& [id, after_s] : times.follows) last = last ? std::max(*last, after_s) : last;
    std::printf("%4d  %16s  %13s  %8s  %10s\n", static_cast<int>(seed),
                text(first(times.in_picture)).c_str(), text(follows).c_str(),
                text(times.located).c_str(), text(last).c_str());
    std::fflush(stdout);
    if (follows && *follows <= kWanted_s) ++one;
    if (last && *last <= kWanted_s) ++all;
  }
  std::printf("within %.0f s of %zu runs a station follows in %zu, all in %zu\n", kWanted_s,
              arguments.seeds.size(), one, all);
}

void watch_alone(const Arguments& arguments) {
  cv::setNumThreads(1);
  const auto scenario = ols::sim::load_scenario(arguments.scenario);
  std::printf(
      "[s of the scenario]\nseed  target      seen   located  named    identities  "
      "wrong names\n");
  std::size_t good = 0;
  for (const std::uint64_t seed : arguments.seeds) {
    const auto elapsed = later(scenario, static_cast<double>(seed - 1) * arguments.apart_s);
    const auto run = ols::sim::run_unattended(
        elapsed, seed, arguments.seconds,
        {ols::fusion::ObjectClass::kUnknown, ols::fusion::ObjectClass::kDrone});
    for (const auto& [id, found] : run.targets) {
      std::printf("%4d  %-10s  %-5s  %-7s  %-7s  %10zu  %11d\n", static_cast<int>(seed), id.c_str(),
                  text(found.seen_s).c_str(), text(found.located_s).c_str(),
                  text(found.named_s).c_str(), found.identities.size(), found.wrong_names);
    }
    std::printf(
        "      first target: held by one after %s, by two %s, by all %s, at the end %zu; "
        "ghosts %zu, false drones %d\n",
        text(held_by(run.first, 1)).c_str(), text(held_by(run.first, 2)).c_str(),
        text(held_by(run.first, run.first.stations)).c_str(), run.stations_on_it, run.ghosts.size(),
        run.drones_that_are_none);
    std::fflush(stdout);
    const auto first = run.targets.find(scenario.targets.front().id);
    const bool found = first != run.targets.end() && first->second.named_s;
    good += found && run.stations_on_it >= 2 && run.drones_that_are_none == 0 ? 1 : 0;
  }
  std::printf(
      "found, tracked by two stations or more at the end, named, and nothing else taken for "
      "a drone: %zu of %zu\n",
      good, arguments.seeds.size());
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Times until stations that have never seen a target follow it.",
               "ols-bench-lead-times");
  Arguments arguments;
  declare(app, arguments);
  return ols::bench::run_program(app, argc, argv, [&] {
    if (app.got_subcommand("unattended")) {
      watch_alone(arguments);
    } else {
      run(arguments, app.got_subcommand("look"));
    }
  });
}
