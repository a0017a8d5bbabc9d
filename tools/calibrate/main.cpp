// ols-calibrate: a station's calibration from whatever it has observed.
#include <filesystem>
#include <iostream>

#include "base/atomic_file.h"
#include "base/command_line.h"
#include "base/output_check.h"
#include "calibration/exchange.h"
#include "tools/calibrate/result_files.h"

namespace {

namespace calibration = ols::calibration;
namespace fs = std::filesystem;

void add_options(CLI::App& app, calibration::CaseOptions& o) {
  app.add_option("--station", o.stations,
                 "its configuration, as ols-station reads it; several for a network")
      ->required();
  app.add_option("--instrument", o.instruments,
                 "TOML: what is known of the instrument; else it is a new unit; one a station");
  app.add_option("--observations", o.observations, "JSON lines; several files are read as one")
      ->required();
  app.add_option("--references", o.references,
                 "CSV: landmark, stars, and positions in time (utime_us)");
  app.add_option("--output", o.output, "folder for the results; it must be new or empty")
      ->required();
  app.add_option("--predict", o.predict,
                 "CSV: pan_counts,tilt_counts,approach_pan,approach_tilt,x_px,y_px,utime_us");
  app.add_option("--ut1-utc", o.ut1_minus_utc_s, "[s] UT1 - UTC, for stars and the sun")
      ->check(CLI::Range(-1.0, 1.0));
  app.add_option("--pressure", o.pressure_hPa, "[hPa] at the station, for stars and the sun")
      ->check(CLI::Range(300.0, 1200.0));
  app.add_option("--temperature", o.temperature_degC, "[degC] for stars and the sun")
      ->check(CLI::Range(-60.0, 60.0));
}

// Nothing that stands there is overwritten: another calibration, an input.
void check_output(const calibration::CaseOptions& o) {
  std::vector<ols::NamedFile> inputs{{"--references", o.references}, {"--predict", o.predict}};
  for (const std::string& path : o.stations) inputs.push_back({"--station", path});
  for (const std::string& path : o.instruments) inputs.push_back({"--instrument", path});
  for (const std::string& path : o.observations) inputs.push_back({"--observations", path});
  ols::check_outputs(inputs, {{"--output", o.output}});
  if (!fs::exists(o.output)) return;
  if (!fs::is_directory(o.output)) {
    throw std::invalid_argument("--output: " + o.output + " is not a folder");
  }
  if (!fs::is_empty(o.output)) {
    throw std::invalid_argument("--output: " + o.output +
                                " is not empty: a calibration is never overwritten");
  }
}

void write(const fs::path& path, const std::string& text) {
  fs::create_directories(path.parent_path());
  ols::AtomicFile file(path.string());
  file.stream() << text;
  file.commit();
}

void adjust(const calibration::CaseOptions& options) {
  check_output(options);
  const calibration::Case what = calibration::read_case(options);
  const calibration::Adjustment adjustment(calibration::network_of(what));
  calibration::Calibration found = calibration::calibrate(adjustment);
  for (const std::string& line :
       calibration::exchanged_landmarks(what.problem, adjustment, found)) {
    found.remarks.push_back(line);
  }
  const auto results = calibration::station_results(what, adjustment, found);
  // All is computed before anything is written.
  const std::string predicted =
      options.predict.empty() ? std::string() : calibration::predictions(what, results);
  const fs::path folder(options.output);
  for (const calibration::StationResult& result : results) {
    const fs::path own = results.size() == 1 ? folder : folder / result.id;
    write(own / "instrument.toml", result.instrument);
    write(own / "setup.toml", result.setup);
    write(own / "covariance.csv", result.covariance_csv);
  }
  if (!predicted.empty()) write(folder / "predictions.csv", predicted);
  write(folder / "report.json", calibration::report_json(what, adjustment, found, results));
  write(folder / "report.html", calibration::report_html(what, adjustment, found, results));
  for (const auto& lines : {found.remarks, what.warnings}) {
    for (const std::string& line : lines) std::cerr << "ols-calibrate: " << line << '\n';
  }
}

}  // namespace

int main(int argc, char** argv) {
  ols::remove_temporary_files_on_signals();
  CLI::App app{"A station's calibration: what its instrument is, and how it stands."};
  app.require_subcommand(1);
  calibration::CaseOptions options;
  add_options(*app.add_subcommand("adjust", "One adjustment of all observations."), options);
  if (const auto status = ols::parse_command_line(app, argc, argv, "ols-calibrate")) {
    return *status;
  }
  try {
    adjust(options);
  } catch (const std::exception& error) {
    std::cerr << "ols-calibrate: " << error.what() << '\n';
    return ols::kExitBadInput;
  }
  return 0;
}
