// ols-bench-look: how long after a click in the overview station's picture all tracking stations
// follow the target, with pictures and in simulated time: the same figures on any computer.
#include <algorithm>
#include <cstdio>
#include <opencv2/core/utility.hpp>
#include <string>
#include <vector>

#include "base/command_line.h"
#include "sim/overview_click.h"

namespace {

struct Arguments {
  std::string scenario = "sim/scenarios/overview.toml";
  std::vector<std::uint64_t> seeds = {1, 2, 3, 4, 5, 6, 7, 8};
  double apart_s = 11.0;
  double patience_s = 20.0;
};

void declare(CLI::App& app, Arguments& arguments) {
  app.add_option("--scenario", arguments.scenario, "scenario file (TOML) with an overview station")
      ->capture_default_str();
  app.add_option("--seeds", arguments.seeds, "of the runs")->delimiter(',')->capture_default_str();
  app.add_option(
         "--apart", arguments.apart_s,
         "[s] of the flight between the clicks of two seeds, so that each has another place")
      ->check(CLI::Range(0.0, 3600.0))
      ->capture_default_str();
  app.add_option("--patience", arguments.patience_s, "[s] after the click, then a run ends")
      ->check(CLI::Range(1.0, 600.0))
      ->capture_default_str();
}

std::string seconds_of(const std::map<std::string, double>& times, const std::string& id) {
  const auto found = times.find(id);
  if (found == times.end()) return "never";
  char text[16];
  std::snprintf(text, sizeof text, "%.2f", found->second);
  return text;
}

void print(const ols::sim::Scenario& scenario, std::uint64_t seed,
           const ols::sim::LeadTimes& times) {
  for (const auto& station : scenario.stations) {
    if (station.overview) continue;
    const auto tried = times.acquisitions.find(station.id);
    std::printf("%4d  %-10s %10s %10s %10s %10d\n", static_cast<int>(seed), station.id.c_str(),
                seconds_of(times.in_picture, station.id).c_str(),
                seconds_of(times.acquired, station.id).c_str(),
                seconds_of(times.follows, station.id).c_str(),
                tried == times.acquisitions.end() ? 0 : tried->second);
  }
  double last_s = 0.0;
  for (const auto& [id, after_s] : times.follows) last_s = std::max(last_s, after_s);
  std::printf("%4d  position after %s s; all follow: %s\n", static_cast<int>(seed),
              times.located ? std::to_string(*times.located).substr(0, 4).c_str() : "never",
              times.complete() ? (std::to_string(last_s).substr(0, 5) + " s").c_str() : "no");
  std::fflush(stdout);
}

void run(const Arguments& arguments) {
  constexpr double kWanted_s = 5.0;
  cv::setNumThreads(1);
  const auto scenario = ols::sim::load_scenario(arguments.scenario);
  std::printf(
      "seed  station    in picture   acquired    follows  acquisitions [s after the click]\n");
  std::size_t within = 0;
  for (const std::uint64_t seed : arguments.seeds) {
    ols::sim::ClickConfig config;
    config.elapsed_s = static_cast<double>(seed) * arguments.apart_s - arguments.apart_s;
    config.patience_s = arguments.patience_s;
    const auto times = ols::sim::click_in_overview(scenario, seed, config);
    print(scenario, seed, times);
    const bool quick = std::ranges::all_of(
        times.follows, [](const auto& station) { return station.second <= kWanted_s; });
    if (times.complete() && quick) ++within;
  }
  std::printf("all follow within %.0f s: %zu of %zu\n", kWanted_s, within, arguments.seeds.size());
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Times from a click in the overview station's picture to all stations following.",
               "ols-bench-look");
  Arguments arguments;
  declare(app, arguments);
  if (const auto status = ols::parse_command_line(app, argc, argv, "ols-bench-look"))
    return *status;
  try {
    run(arguments);
    ols::flush_output();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "ols-bench-look: %s\n", error.what());
    return ols::kExitBadInput;
  }
  return 0;
}
