// ols-stationing: a station's heading, tilt and mounting from sighted landmarks.
#include <iostream>

#include "base/atomic_file.h"
#include "base/command_line.h"
#include "geometry/angles.h"
#include "tools/offline/stationing_files.h"

namespace {

struct Options {
  ols::StationingOptions stationing;
  std::string output;  // empty: the standard output
};

void add_options(CLI::App& app, Options& options) {
  ols::StationingOptions& o = options.stationing;
  app.add_option("--station", o.station, "its configuration, as ols-station reads it")->required();
  app.add_option("--landmarks", o.landmarks,
                 "CSV: landmark,height_m,sd_m and latitude_deg,longitude_deg or "
                 "zone,easting_m,northing_m (UTM; zone as 33N); ellipsoidal heights")
      ->required();
  app.add_option("--sightings", o.sightings,
                 "CSV: landmark,pan_deg,tilt_deg[,x_px,y_px]; angles as the PTU reports them; "
                 "without a pixel: where the optical axis meets the picture")
      ->required();
  app.add_option("--at", o.at,
                 "the landmark where the station's GROUND is; else [pose] says where");
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
  app.add_option("--output", options.output, "TOML for the configuration; else it is printed");
}

void run(const Options& options) {
  const ols::StationingCase before = ols::read_stationing(options.stationing);
  const ols::Stationing found =
      ols::find_station(before, ols::radians(options.stationing.highest_deg));
  for (const std::string& warning : ols::stationing_warnings(before, found)) {
    std::cerr << "ols-stationing: " << warning << '\n';
  }
  const bool with_position = !options.stationing.at.empty();
  if (options.output.empty()) {
    ols::write_stationing(std::cout, before, found, with_position);
    ols::flush_output();
    return;
  }
  ols::AtomicFile file(options.output);
  ols::write_stationing(file.stream(), before, found, with_position);
  file.commit();
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"A station's heading, tilt and mounting from sightings of surveyed landmarks."};
  Options options;
  add_options(app, options);
  if (const auto status = ols::parse_command_line(app, argc, argv, "ols-stationing")) {
    return *status;
  }
  try {
    run(options);
  } catch (const std::exception& error) {
    std::cerr << "ols-stationing: " << error.what() << '\n';
    return ols::kExitBadInput;
  }
  return 0;
}
