// ols-fuse: positions from recorded bearings.
#include <Eigen/Core>
#include <algorithm>
#include <future>
#include <iostream>
#include <map>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "base/files/atomic_file.h"
#include "base/files/csv_files.h"
#include "base/files/output_check.h"
#include "base/process/command_line.h"
#include "base/process/progress.h"
#include "central/offline/object_separation.h"
#include "central/offline/offline_fusion.h"
#include "central/offline/smoother.h"
#include "geometry/angles.h"
#include "geometry/wgs84.h"
#include "tools/offline/fix_writer.h"
#include "tools/offline/recorded_bearings.h"

namespace {

constexpr int kExitNoPosition = 1;

const std::map<std::string, ols::fusion::PaperPairs> kPaperPairs = {
    {"algorithm-1", ols::fusion::PaperPairs::kAlgorithm1},
    {"centroid", ols::fusion::PaperPairs::kCentroid},
    {"best-baseline", ols::fusion::PaperPairs::kBestBaseline}};

struct Options {
  std::string stations;
  std::string bearings;
  std::string output;
  std::string estimator = "filter";
  bool smooth = false;
  double rate_hz = 0.0;
  std::optional<double> clock_sd_s;  // nothing: guessed
  ols::fusion::PaperConfig paper{};
  std::string paper_pairs = "algorithm-1";
  bool paper_halves = false;
};

ols::FixRow fix_of(const ols::fusion::FusedTarget& target, const std::string& id) {
  const ols::fusion::Estimate& estimate = target.estimate;
  const ols::Geodetic place = ols::geodetic_from_ecef(estimate.position_ecef);
  const Eigen::Matrix3d R = ols::R_ecef_enu(place);
  const Eigen::Vector3d sd = (R.transpose() * estimate.covariance_ecef * R).diagonal().cwiseSqrt();
  const auto used = std::ranges::count_if(target.stations, &ols::fusion::ContributingStation::used);
  ols::FixRow fix;
  fix.utime_us = target.utime_us;
  fix.target = id;
  fix.latitude_deg = ols::degrees(place.latitude_rad);
  fix.longitude_deg = ols::degrees(place.longitude_rad);
  fix.height_m = place.height_m;
  fix.east_sd_m = sd.x();
  fix.north_sd_m = sd.y();
  fix.up_sd_m = sd.z();
  fix.stations_used = static_cast<int>(used);
  fix.stations_set_aside = static_cast<int>(target.stations.size()) - fix.stations_used;
  fix.crossing_angle_deg = ols::degrees(estimate.crossing_angle_rad);
  fix.residual = estimate.residual;
  return fix;
}

struct Unused {
  std::size_t low_belief = 0, duplicate = 0, unexplained = 0;
};

void tell_unused(const Unused& unused, std::size_t bearings) {
  const std::size_t all = unused.low_belief + unused.duplicate + unused.unexplained;
  if (all == 0) return;
  std::cerr << "ols-fuse: " << all << " of " << bearings << " bearings not used:";
  const char* separator = " ";
  for (const auto& [count, why] :
       {std::pair(unused.low_belief, "of low belief"),
        std::pair(unused.duplicate, "with an earlier bearing's station and time"),
        std::pair(unused.unexplained, "of no target")}) {
    if (count == 0) continue;
    std::cerr << separator << count << ' ' << why;
    separator = ", ";
  }
  std::cerr << '\n';
}

// What may be wrong where there is no position; empty: the word says it.
const char* cause_of(ols::fusion::Solution solution) {
  using ols::fusion::Solution;
  switch (solution) {
    case Solution::kTooFewRays:
    case Solution::kBearingOnly:
      return "fewer than two stations see the target at that time";
    case Solution::kParallelRays:
      return "the lines of sight are almost parallel: the stations stand too close together";
    case Solution::kBehindCamera:
      return "the lines of sight meet behind a station: is one station's place or north wrong, or "
             "latitude exchanged with longitude?";
    case Solution::kTooFar:
      return "the lines of sight meet beyond 500 km: is one station's place or north wrong, or "
             "latitude exchanged with longitude?";
    case Solution::kRaysMiss:
      return "the lines of sight do not meet: is one station's place or north wrong, or do they "
             "see different objects?";
    case Solution::kAmbiguous:
      return "two stations see several objects, and it is open which belong together";
    case Solution::kNotConverged:
      return "the lines of sight contradict each other";
    case Solution::kOk:
      break;
  }
  return "";
}

// The states in which there is no position, at how many of the instants, and why.
void tell_unlocated(const ols::fusion::Unlocated& unlocated, std::size_t fixes,
                    const std::string& id) {
  if (unlocated.empty()) return;
  std::size_t instants = fixes;
  for (const auto& [solution, count] : unlocated) instants += count;
  std::cerr << "ols-fuse: target " << id << ": no position at";
  const char* separator = " ";
  for (const auto& [solution, count] : unlocated) {
    std::cerr << separator << count << " of " << instants << " instants (" << to_string(solution)
              << ')';
    separator = ", ";
  }
  std::cerr << '\n';
  for (const auto& [solution, count] : unlocated) {
    std::cerr << "ols-fuse: " << to_string(solution) << ": " << cause_of(solution) << '\n';
  }
}

ols::fusion::OfflineConfig config_of(const Options& options) {
  ols::fusion::OfflineConfig config;
  config.estimator = options.estimator;
  config.smooth = options.smooth;
  config.rate_hz = options.rate_hz;
  if (!options.clock_sd_s) config.fusion.tracks.errors.clock_weight = 1.0;  // guesses are learnt
  config.fusion.estimators.paper = options.paper;
  config.fusion.estimators.paper.pairs = kPaperPairs.at(options.paper_pairs);
  config.fusion.estimators.paper.by_belief = !options.paper_halves;
  return config;
}

// Progress of the filters, over all their runs.
class Steps {
 public:
  Steps(std::size_t bearings, std::size_t runs) : bearings_(bearings), runs_(runs) {}
  void operator()() {
    const std::lock_guard lock(mutex_);
    progress_(++done_ / runs_, bearings_);
  }

 private:
  std::size_t bearings_, runs_, done_ = 0;
  ols::Progress progress_{"ols-fuse", "bearings"};
  std::mutex mutex_;
};

ols::fusion::Workers all_processors() {
  const auto run = [](const ols::fusion::Tasks& tasks) {
    std::vector<std::future<void>> others;
    for (std::size_t i = 1; i < tasks.size(); ++i)
      others.push_back(std::async(std::launch::async, tasks[i]));
    tasks.front()();
    for (std::future<void>& other : others) other.get();
  };
  return {std::clamp<std::size_t>(std::thread::hardware_concurrency(), 1, 8), run};
}

// How often filters process each bearing.
std::size_t runs_of(const Options& options, std::size_t bearings, bool separates) {
  return 1 + (options.smooth ? ols::fusion::smoother_runs(bearings) : 0) + (separates ? 1 : 0);
}

void set_clocks(const Options& options, const ols::fusion::MutableBearings& all) {
  if (!options.clock_sd_s) return ols::fusion::guess_clocks(all);
  for (ols::fusion::BearingMeasurement* bearing : all) bearing->clock_sd_s = *options.clock_sd_s;
}

using Targets = std::vector<ols::offline::RecordedTarget>;

// The targets of a file that names none, but shows several: those of the live tracks.
Targets separated(const ols::offline::RecordedTarget& anonymous,
                  const ols::fusion::OfflineConfig& config, Unused& unused) {
  auto found = ols::fusion::separate_objects(anonymous.bearings, config.fusion, config.tell);
  unused = {found.low_belief, found.duplicate, found.unexplained};
  Targets targets;
  for (auto& [id, bearings] : found.objects)
    targets.push_back({std::to_string(id), std::move(bearings)});
  return targets;
}

// Writes fixes in order of time: of one target at once, of several at the end.
class Output {
 public:
  Output(const std::string& path, bool several) : writer_(path), several_(several) {}
  void add(const ols::FixRow& fix) {
    ++count_;
    if (several_) {
      fixes_.push_back(fix);
    } else {
      writer_.add(fix);
    }
  }
  std::size_t commit() {
    std::ranges::stable_sort(fixes_, {}, &ols::FixRow::utime_us);
    for (const ols::FixRow& fix : fixes_) writer_.add(fix);
    if (count_ > 0) writer_.commit();  // else the file of an earlier run stays
    return count_;
  }

 private:
  ols::FixWriter writer_;
  bool several_;
  std::vector<ols::FixRow> fixes_;
  std::size_t count_ = 0;
};

void fuse(const ols::offline::RecordedTarget& target, const ols::fusion::OfflineConfig& config,
          Output& output, Unused& unused) {
  std::size_t fixes = 0;
  const auto report = ols::fusion::fuse_offline({target.bearings.begin(), target.bearings.end()},
                                                config, [&](const ols::fusion::FusedTarget& fused) {
                                                  output.add(fix_of(fused, target.name));
                                                  ++fixes;
                                                });
  unused.low_belief += report.unused.low_belief;
  unused.duplicate += report.unused.duplicate;
  for (const auto& [station, why] : report.beside) {
    std::cerr << "ols-fuse: station " << station << ", target " << target.name << ": " << why
              << '\n';
  }
  tell_unlocated(report.unlocated, fixes, target.name);
}

// How many positions there are.
std::size_t run(const Options& options) {
  ols::check_outputs({{"--stations", options.stations}, {"--bearings", options.bearings}},
                     {{"--output", options.output}});
  auto recording = ols::offline::read_recorded_bearings(options.stations, options.bearings);
  const std::size_t bearings = recording.bearings.size();
  Targets targets = ols::offline::targets_of(recording);
  const bool separates =
      recording.targets.empty() && ols::fusion::shows_several_objects(targets.front().bearings);
  ols::fusion::OfflineConfig config = config_of(options);
  Steps steps(bearings, runs_of(options, bearings, separates));
  config.tell = [&steps] { steps(); };
  config.workers = all_processors();
  Unused unused;
  for (const auto& target : targets) set_clocks(options, target.bearings);
  if (separates) {
    targets = separated(targets.front(), config, unused);
    // Clocks need separate objects: over all of them, a station's bearings seem to jump.
    for (const auto& target : targets) set_clocks(options, target.bearings);
  }
  Output output(options.output, targets.size() > 1);
  for (const auto& target : targets) fuse(target, config, output, unused);
  tell_unused(unused, bearings);
  return output.commit();
}

void add_files(CLI::App& app, Options& options) {
  app.add_option("--stations", options.stations,
                 "CSV: station,latitude_deg,longitude_deg,height_m[,position_sd_m,pointing_sd_deg]")
      ->required();
  app.add_option("--bearings", options.bearings,
                 "CSV: utime_us,station,azimuth_deg,elevation_deg,sigma_deg[,belief,target]")
      ->required();
  app.add_option("--output", options.output,
                 "CSV: utime_us,target,latitude_deg,longitude_deg,height_m,east_sd_m,north_sd_m,"
                 "up_sd_m,...")
      ->required();
}

void add_choices(CLI::App& app, Options& options) {
  app.add_option("--estimator", options.estimator,
                 "filter (over time), least-squares (all rays of an instant) or paper")
      ->check(CLI::IsMember({"filter", "least-squares", "paper"}))
      ->capture_default_str();
  app.add_flag("--smooth", options.smooth,
               "with the filter: use the bearings after each instant too");
  app.add_option("--paper-pairs", options.paper_pairs,
                 "with paper: pairs of stations, by algorithm-1, centroid (unweighted) or "
                 "best-baseline (section 4.1)")
      ->check(CLI::IsMember(kPaperPairs))
      ->capture_default_str();
  app.add_flag("--paper-halves", options.paper_halves,
               "with paper: turn both views by half of the angle, whatever their beliefs");
  app.add_option("--rate", options.rate_hz,
                 "[Hz] fixes on an even grid in time; 0: at the instant of every bearing")
      ->check(CLI::Range(0.0, 10000.0))
      ->capture_default_str();
  app.add_option("--clock-sd", options.clock_sd_s,
                 "[s] 1-sigma of each station's clock, which is not in the files; default: "
                 "estimated from noise and angular speed")
      ->check(CLI::Range(0.0, 10.0));
  app.add_option("--moving-average", options.paper.moving_average,
                 "[fixes] with paper: mean of the last so many; 1: none")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
}

}  // namespace

int main(int argc, char** argv) {
  ols::remove_temporary_files_on_signals();
  CLI::App app{"Positions (WGS84, metres above the ellipsoid, 1-sigma) from recorded bearings."};
  app.set_version_flag("--version", OLS_VERSION);
  Options options;
  add_files(app, options);
  add_choices(app, options);
  return ols::run_command(app, argc, argv, "ols-fuse", [&] {
    if (run(options) != 0) return 0;
    std::cerr << "ols-fuse: no position at all: " << options.output << " is not written\n";
    return kExitNoPosition;
  });
}
