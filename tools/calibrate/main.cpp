// ols-calibrate: a station's calibration from whatever it has observed.
#include <csignal>
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

fs::path partial_of(const fs::path& folder) { return folder.string() + ".partial"; }

// Nothing that stands there is overwritten: another calibration, an input.
fs::path output_folder(const calibration::CaseOptions& o) {
  if (o.output.empty()) throw std::invalid_argument("--output: is empty");
  std::vector<ols::NamedFile> inputs{{"--references", o.references}, {"--predict", o.predict}};
  for (const std::string& path : o.stations) inputs.push_back({"--station", path});
  for (const std::string& path : o.instruments) inputs.push_back({"--instrument", path});
  for (const std::string& path : o.observations) inputs.push_back({"--observations", path});
  ols::check_outputs(inputs, {{"--output", o.output}});
  // Without links and a slash at the end: the name that a rename needs.
  fs::path folder = fs::weakly_canonical(o.output);
  if (!folder.has_filename()) folder = folder.parent_path();
  if (fs::exists(partial_of(folder))) {
    throw std::invalid_argument("--output: " + partial_of(folder).string() +
                                " exists: remove what an interrupted run has left");
  }
  if (!fs::exists(folder)) return folder;
  if (!fs::is_directory(folder)) {
    throw std::invalid_argument("--output: " + o.output + " is not a folder");
  }
  if (!fs::is_empty(folder)) {
    throw std::invalid_argument("--output: " + o.output +
                                " is not empty: a calibration is never overwritten");
  }
  return folder;
}

// The results are of a few kilobytes: a signal waits until they are there.
class SignalsWait {
 public:
  SignalsWait() {
    sigset_t signals;
    sigemptyset(&signals);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&signals, signal);
    ::pthread_sigmask(SIG_BLOCK, &signals, &before_);
  }
  ~SignalsWait() { ::pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  SignalsWait(const SignalsWait&) = delete;
  SignalsWait& operator=(const SignalsWait&) = delete;

 private:
  sigset_t before_{};
};

// All of them or none: they get their name when all are written.
void write(const fs::path& folder, const std::vector<calibration::OutputFile>& files) {
  const SignalsWait wait;
  const fs::path partial = partial_of(folder);
  if (folder.has_parent_path()) fs::create_directories(folder.parent_path());
  if (!fs::create_directory(partial)) throw std::runtime_error(partial.string() + ": exists");
  try {
    for (const calibration::OutputFile& one : files) {
      const fs::path path = partial / one.name;
      fs::create_directories(path.parent_path());
      ols::AtomicFile file(path.string());
      file.stream() << one.text;
      file.commit();
    }
    fs::rename(partial, folder);
  } catch (const std::exception&) {
    std::error_code ignored;
    fs::remove_all(partial, ignored);
    throw;
  }
}

void adjust(const calibration::CaseOptions& options) {
  const fs::path folder = output_folder(options);
  const calibration::Case what = calibration::read_case(options);
  const calibration::Adjustment adjustment(calibration::network_of(what));
  calibration::Calibration found = calibration::calibrate(adjustment);
  for (const std::string& line :
       calibration::exchanged_landmarks(what.problem, adjustment, found)) {
    found.remarks.push_back(line);
  }
  write(folder, calibration::output_files(what, adjustment, found));
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
