// ols-stationing: a station's heading, tilt and mounting from sighted landmarks.
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>

#include "base/config/toml_merge.h"
#include "base/files/atomic_file.h"
#include "base/files/output_check.h"
#include "base/process/command_line.h"
#include "geometry/angles.h"
#include "tools/calibrate/stationing_files.h"

namespace {

struct Options {
  ols::calibration::StationingOptions stationing;
  std::string output;  // empty: the standard output
  bool in_place = false, find_position = false;
};

void add_options(CLI::App& app, Options& options) {
  ols::calibration::StationingOptions& o = options.stationing;
  app.add_option("--station", o.station, "its configuration, as ols-station reads it")->required();
  app.add_option("--landmarks", o.landmarks,
                 "CSV: landmark,height_m,sd_m and latitude_deg,longitude_deg or "
                 "zone,easting_m,northing_m (UTM; zone as 33N); ellipsoidal heights")
      ->required();
  app.add_option("--sightings", o.sightings,
                 "CSV: landmark,pan_deg,tilt_deg[,x_px,y_px]; angles as the PTU reports them; "
                 "without a pixel: where the optical axis meets the image")
      ->required();
  app.add_option("--at", o.at,
                 "the landmark where the station's GROUND is; else [pose] says where");
  app.add_flag("--find-position", options.find_position,
               "improve the position, too: for one read on a map, which calibration.sd.position_m "
               "says how well is known");
  app.add_option("--pixel-sd", o.pixel_sd_px, "[px] 1-sigma of each coordinate")
      ->check(CLI::Range(1e-3, 1e3))
      ->capture_default_str();
  app.add_option("--angles-sd", o.angles_sd_deg, "[deg] 1-sigma of each angle of the PTU")
      ->check(CLI::Range(0.0, 10.0))
      ->capture_default_str();
  app.add_option("--highest", o.highest_deg,
                 "[deg] targets are no higher: up to there the stated deviations hold")
      ->check(CLI::Range(0.0, 80.0))
      ->capture_default_str();
  CLI::Option* output =
      app.add_option("--output", options.output, "TOML for the configuration; else it is printed");
  app.add_flag("--in-place", options.in_place,
               "also change these values in the --station file; the old one is kept as FILE.old")
      ->excludes(output);
}

// The first of station.toml.old, station.toml.old-2, ... that is free.
std::string keep_copy(const std::filesystem::path& path) {
  std::string copy = path.string() + ".old";
  for (int i = 2; std::filesystem::exists(copy); ++i) {
    copy = path.string() + ".old-" + std::to_string(i);
  }
  std::filesystem::copy_file(path, copy);
  return copy;
}

void change_in_place(const std::string& path, const std::string& found) {
  std::ostringstream old_text;
  old_text << std::ifstream(path).rdbuf();
  const std::string merged = ols::toml_merged(old_text.str(), found);
  const std::string copy = keep_copy(path);
  ols::AtomicFile file(path);
  file.stream() << merged;
  file.commit();
  std::cerr << "ols-stationing: " << path << " is changed, the old one is " << copy << '\n';
}

void run(const Options& options) {
  const ols::calibration::StationingOptions& files = options.stationing;
  ols::check_outputs({{"--station", files.station},
                      {"--landmarks", files.landmarks},
                      {"--sightings", files.sightings}},
                     {{"--output", options.output}});
  const ols::calibration::StationingCase before =
      ols::calibration::read_stationing(options.stationing);
  ols::calibration::Stationing found =
      ols::calibration::find_station(before, ols::radians(options.stationing.highest_deg));
  for (const std::string& warning : ols::calibration::stationing_warnings(before, found)) {
    std::cerr << "ols-stationing: " << warning << '\n';
  }
  if (options.find_position) {
    found.station.position = found.position;
    found.station.sd.position_m = found.position_sd_m;
  }
  const bool with_position = options.find_position || !options.stationing.at.empty();
  if (options.output.empty()) {
    std::ostringstream text;
    ols::calibration::write_stationing(text, before, found, with_position);
    std::cout << text.str();
    ols::flush_output();
    if (options.in_place) change_in_place(files.station, text.str());
    return;
  }
  ols::AtomicFile file(options.output);
  ols::calibration::write_stationing(file.stream(), before, found, with_position);
  file.commit();
}

}  // namespace

int main(int argc, char** argv) {
  ols::remove_temporary_files_on_signals();
  CLI::App app{"A station's heading, tilt and mounting from sightings of surveyed landmarks."};
  app.set_version_flag("--version", OLS_VERSION);
  Options options;
  add_options(app, options);
  return ols::run_command(app, argc, argv, "ols-stationing", [&] {
    run(options);
    return 0;
  });
}
