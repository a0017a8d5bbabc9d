// ols-sim: the simulated site, live behind real wires or in lockstep without any.

#include <algorithm>
#include <chrono>
#include <iostream>
#include <opencv2/core.hpp>

#include "base/bus/lcm_bus.h"
#include "base/process/command_line.h"
#include "base/process/shutdown.h"
#include "sim/live/live_site.h"
#include "sim/lockstep/lockstep.h"
#include "sim/lockstep/report.h"
#include "sim/scenario/station_files.h"
#include "sim/scenario/station_truth_file.h"
#include "sim/world/world.h"

namespace {

struct Options {
  std::string scenario;
  std::uint64_t seed = 1;
  std::string lcm_url = "udpm://239.255.76.67:7667?ttl=0";
  std::string line_folder = "/tmp/ols-sim";
  std::string config_folder;
  bool list = false;
  bool lockstep = false;
  bool pixels = false;
  double pixel_sd_px = 0.3;
  double seconds = 60.0;
  std::string state_folder;
  std::string output;
  std::string target;
  std::vector<std::string> without;
  std::string stationing;
  std::string round_folder;
  std::string truth_folder;
  std::string calibrations;
};

void define(CLI::App& app, Options& o) {
  app.add_option("--scenario", o.scenario, "scenario file (TOML)")->required();
  app.add_option("--seed", o.seed, "seed of all random numbers")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  app.add_option("--lcm-url", o.lcm_url, "LCM network of the stations and of the truth")
      ->capture_default_str();
  app.add_option("--directory", o.line_folder, "folder for the links to the PTUs' serial lines")
      ->capture_default_str();
  app.add_option("--write-configs", o.config_folder,
                 "write the stations' configuration files into this folder and exit");
  app.add_option("--state-folder", o.state_folder,
                 "with --write-configs: folder of the stations' persisted state; new stations are "
                 "released, with a checked PTU reference");
  app.add_flag("--list", o.list,
               "print id, camera address and serial line of each station and exit");
  app.add_option("--target", o.target, "simulate only this target of the scenario (its id)");
  app.add_option("--without", o.without,
                 "switch off these errors of the scenario: heading,tilt,...")
      ->delimiter(',');
  app.add_option("--stationing", o.stationing,
                 "how the stations find their headings, in place of the scenario's method: drawn, "
                 "each-other, landmarks");
  app.add_option(
      "--write-observations", o.round_folder,
      "write what each station observes to be calibrated (stars, landmarks), as files of "
      "ols-calibrate, into this folder and exit");
  app.add_option("--write-truth", o.truth_folder,
                 "write what is true of each station (JSON) into this folder and exit");
  const auto lockstep =
      app.add_flag("--lockstep", o.lockstep, "simulated time, stations and fusion in this process");
  app.add_option("--seconds", o.seconds, "[s] length of the lockstep run")
      ->capture_default_str()
      ->check(CLI::Range(1.0, 86400.0));
  app.add_option("--output", o.output, "folder for the lockstep run's files")->needs(lockstep);
  lockstep->needs("--output");
  app.add_flag("--pixels", o.pixels, "lockstep without images: the pixel is the truth plus noise")
      ->needs(lockstep);
  app.add_option("--calibrations", o.calibrations,
                 "folder with a calibration of ols-calibrate for each station, by its id")
      ->needs(lockstep)
      ->check(CLI::ExistingDirectory);
  app.add_option("--pixel-sd", o.pixel_sd_px, "[px] deviation of that noise, each coordinate")
      ->capture_default_str()
      ->check(CLI::Range(0.001, 100.0));
}

void list(const ols::sim::Scenario& scenario, const std::string& line_folder) {
  for (const auto& station : scenario.stations) {
    std::cout << station.id << " " << station.camera_address << " " << line_folder << "/"
              << station.ptu_line << "\n";
  }
}

void run_live(const ols::sim::World& world, const Options& options) {
  constexpr auto kTruthInterval = std::chrono::milliseconds(33);
  constexpr int kTurn_ms = 5;
  cv::setNumThreads(1);  // the cameras' threads are the parallelism
  ols::trust::Self self;
  self.name = "simulator";
  ols::LcmBus bus(options.lcm_url,
                  ols::trust::BusTrust::open({}, ols::trust::process_environment(), self));
  ols::sim::LiveSite site(world, options.line_folder, bus);
  std::cout << "ready" << std::endl;
  auto truth_due = std::chrono::steady_clock::now();
  while (!ols::shutdown_requested()) {
    bus.handle(kTurn_ms);
    site.apply_faults();
    const auto now = std::chrono::steady_clock::now();
    if (now < truth_due) continue;
    truth_due = std::max(truth_due + kTruthInterval, now);
    site.publish_truth();
  }
}

void run_lockstep(const ols::sim::World& world, const Options& options) {
  cv::setNumThreads(1);
  std::vector<std::optional<ols::StationCalibration>> calibrations;
  if (!options.calibrations.empty()) {
    calibrations = ols::sim::read_calibrations(world, options.calibrations);
  }
  ols::sim::Lockstep lockstep(world, {!options.pixels, options.pixel_sd_px}, calibrations);
  lockstep.run(options.seconds);
  ols::sim::write_report(world, lockstep.result(), options.seconds, options.output);
}

void run(const Options& options) {
  auto scenario = ols::sim::load_scenario(options.scenario);
  if (!options.target.empty()) ols::sim::keep_target(scenario, options.target);
  for (const auto& name : options.without) ols::sim::switch_off(scenario.errors, name);
  if (!options.stationing.empty()) {
    ols::sim::choose_stationing(scenario.stationing, options.stationing);
  }
  const ols::sim::World world(scenario, options.seed);
  if (options.list) {
    list(scenario, options.line_folder);
  } else if (!options.config_folder.empty()) {
    ols::sim::write_station_files(
        world, {options.lcm_url, options.line_folder, options.state_folder}, options.config_folder);
  } else if (!options.round_folder.empty()) {
    ols::sim::write_calibration_rounds(
        world, {options.lcm_url, options.line_folder, options.state_folder}, options.round_folder);
  } else if (!options.truth_folder.empty()) {
    ols::sim::write_station_truths(world, options.truth_folder);
  } else if (options.lockstep) {
    run_lockstep(world, options);
  } else {
    run_live(world, options);
  }
}

}  // namespace

int main(int argc, char** argv) {
  ols::install_shutdown_handler();
  CLI::App app(
      "The simulated site: cameras, PTUs, targets and their truth. Angles in files are in "
      "degrees, lengths in metres.");
  app.set_version_flag("--version", OLS_VERSION);
  Options options;
  define(app, options);
  return ols::run_command(app, argc, argv, "ols-sim", [&] {
    run(options);
    return 0;
  });
}
