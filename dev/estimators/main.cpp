// ols-bench-estimators: how near the estimators come to their bounds, how consistent their
// covariances are, how well targets are kept apart, and what a bearing costs. Prints one table a
// measure; exits with 1 where a measure of accuracy misses its limit.
#include <algorithm>
#include <cstdio>
#include <optional>
#include <string>

#include "dev/bench/program.h"
#include "dev/estimators/long_recording.h"
#include "dev/estimators/measures.h"
#include "dev/estimators/peer.h"

using namespace ols;
using namespace ols::bench;

namespace {

constexpr int kExitMissed = 1;

// Whether every measure holds its limit.
bool measure(const std::string& what, bool quick, int runs, std::optional<int> stations) {
  if (quick) runs = std::max(2, runs / 2);
  const bool all = what == "all";
  Limits limits;
  if (all || what == "least-squares") least_squares_bound(20 * runs, limits);
  if (all || what == "filter") filter_bounds(runs, limits);
  if (all || what == "paper") against_paper(std::max(20, runs / 5), limits);
  if (all || what == "targets") several(std::max(2, runs / (quick ? 10 : 5)), limits);
  if (what == "traffic" || (all && !quick)) traffic(std::max(2, runs / 10), limits);
  if (what == "handover" || (all && !quick)) handover(std::max(2, runs / 2), limits);
  if (all || what == "meteors") meteors(2 * runs, limits);
  if (all || what == "noise-only") noise_only(quick ? runs / 2 : runs, limits);
  if (what == "classes" || (all && !quick)) classes(5 * runs, limits);
  if (what == "cost" || (all && !quick)) cost(limits, stations);
  return limits.missed() == 0;
}

}  // namespace

int main(int argc, char** argv) {
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  CLI::App app("Monte Carlo measures of the estimators on simulated bearings",
               "ols-bench-estimators");
  int runs = 100;
  bool quick = false;
  std::string what = "all";
  app.add_option("--runs", runs, "Monte Carlo runs of each measure")
      ->check(CLI::Range(2, 100000))
      ->capture_default_str();
  app.add_flag("--quick", quick, "the measures of accuracy alone, in half of the runs or fewer");
  app.add_option(
         "measure", what,
         "all, least-squares, filter, paper, targets, traffic, handover, meteors, noise-only, "
         "classes or cost")
      ->check(CLI::IsMember({"all", "least-squares", "filter", "paper", "targets", "traffic",
                             "handover", "meteors", "noise-only", "classes", "cost"}));
  std::string peer;
  app.add_option("--write-peer", peer,
                 "instead: a folder for bearings and our filter's fixes, as tools/bench estimators "
                 "gives them to Stone Soup");
  std::string looks;
  app.add_option("--write-class-looks", looks,
                 "instead: a file of looks at simulated objects of known class");
  std::string folder;
  LongRecording recording;
  bool anonymous = false;
  app.add_option("--write-recording", folder,
                 "instead: a folder for stations.csv and bearings.csv of a long recording");
  app.add_option("--rows", recording.rows, "its bearings")->capture_default_str();
  const CLI::Option* const stations =
      app.add_option("--stations", recording.stations,
                     "its stations; with cost: of the only site that is measured")
          ->check(CLI::Range(2, 1000))
          ->capture_default_str();
  app.add_option("--targets", recording.targets, "its targets")
      ->check(CLI::Range(1, 100))
      ->capture_default_str();
  app.add_flag("--anonymous", anonymous, "without the column `target`");
  bool holds = true;
  const int status = run_program(app, argc, argv, [&] {
    recording.are_named = !anonymous;
    if (!peer.empty()) {
      write_peer_runs(peer, runs);
    } else if (!looks.empty()) {
      write_class_looks(looks, runs);
    } else if (!folder.empty()) {
      write_long_recording(folder, recording);
    } else {
      holds =
          measure(what, quick, runs, *stations ? std::optional(recording.stations) : std::nullopt);
    }
  });
  return holds ? status : kExitMissed;
}
