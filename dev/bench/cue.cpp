// ols-bench-cue: how long after an operator has allowed a cue from outside the stations see and
// follow its target, with pictures and in simulated time: the same figures on any computer.
#include <algorithm>
#include <cstdio>
#include <opencv2/core/utility.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/command_line.h"
#include "sim/outside_cue.h"

namespace {

struct Arguments {
  std::string scenario = "sim/scenarios/overview.toml";
  std::vector<std::uint64_t> seeds = {1, 2, 3, 4, 5, 6};
  double apart_s = 11.0;
  bool places_only = false;
  ols::sim::OutsideCueConfig cue;
};

void declare(CLI::App& app, Arguments& arguments) {
  app.add_option("--scenario", arguments.scenario, "scenario file (TOML)")->capture_default_str();
  app.add_option("--seeds", arguments.seeds, "of the runs")->delimiter(',')->capture_default_str();
  app.add_option("--apart", arguments.apart_s,
                 "[s] of the flight between two seeds, so that each has another place")
      ->check(CLI::Range(0.0, 3600.0))
      ->capture_default_str();
  app.add_option("--sd", arguments.cue.sd_m, "[m] 1-sigma of the cue's places, each axis")
      ->check(CLI::Range(0.1, 1000.0))
      ->capture_default_str();
  app.add_option("--report", arguments.cue.report_s, "[s] between two places of the source")
      ->check(CLI::Range(0.1, 60.0))
      ->capture_default_str();
  app.add_option("--delay", arguments.cue.delay_s, "[s] by which they are late")
      ->check(CLI::Range(0.0, 9.0))
      ->capture_default_str();
  app.add_flag("--places-only", arguments.places_only, "the source says no velocity");
  app.add_option("--patience", arguments.cue.patience_s, "[s] after the word, then a run ends")
      ->check(CLI::Range(1.0, 600.0))
      ->capture_default_str();
}

std::optional<double> first(const std::map<std::string, double>& times) {
  if (times.empty()) return std::nullopt;
  return std::ranges::min_element(times, {}, [](const auto& one) { return one.second; })->second;
}

std::string text(const std::optional<double>& seconds) {
  if (!seconds) return "never";
  char text[16];
  std::snprintf(text, sizeof text, "%.2f", *seconds);
  return text;
}

void run(Arguments arguments) {
  constexpr double kWanted_s = 5.0;
  cv::setNumThreads(1);
  const auto scenario = ols::sim::load_scenario(arguments.scenario);
  arguments.cue.with_velocity = !arguments.places_only;
  std::printf("[s after the operator's word]\n");
  std::printf("seed  first in picture  first follows  position  all follow\n");
  std::size_t within = 0;
  for (const std::uint64_t seed : arguments.seeds) {
    arguments.cue.elapsed_s = static_cast<double>(seed) * arguments.apart_s - arguments.apart_s;
    const auto times = ols::sim::cue_from_outside(scenario, seed, arguments.cue);
    std::optional<double> last;
    for (const auto& [id, after_s] : times.follows) last = std::max(last.value_or(0.0), after_s);
    if (!times.complete()) last.reset();
    const auto follows = first(times.follows);
    std::printf("%4d  %16s  %13s  %8s  %10s\n", static_cast<int>(seed),
                text(first(times.in_picture)).c_str(), text(follows).c_str(),
                text(times.located).c_str(), text(last).c_str());
    std::fflush(stdout);
    if (follows && *follows <= kWanted_s) ++within;
  }
  std::printf("a station follows within %.0f s: %zu of %zu\n", kWanted_s, within,
              arguments.seeds.size());
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Times from a cue from outside to stations that see and follow its target.",
               "ols-bench-cue");
  Arguments arguments;
  declare(app, arguments);
  if (const auto status = ols::parse_command_line(app, argc, argv, "ols-bench-cue")) return *status;
  try {
    run(arguments);
    ols::flush_output();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "ols-bench-cue: %s\n", error.what());
    return ols::kExitBadInput;
  }
  return 0;
}
