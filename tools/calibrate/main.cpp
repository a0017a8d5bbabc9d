// ols-calibrate: a station's calibration from whatever it has observed.
#include <filesystem>
#include <iostream>
#include <map>
#include <new>

#include "base/files/atomic_file.h"
#include "base/files/output_check.h"
#include "base/process/command_line.h"
#include "base/process/progress.h"
#include "tools/calibrate/adjust_command.h"
#include "tools/calibrate/aircraft.h"
#include "tools/calibrate/camera.h"
#include "tools/calibrate/command_report.h"
#include "tools/calibrate/delay_command.h"
#include "tools/calibrate/mount_command.h"
#include "tools/calibrate/output_folder.h"
#include "tools/calibrate/procedure_commands.h"
#include "tools/calibrate/scenery_command.h"
#include "tools/calibrate/tracks.h"
#include "tools/calibrate/zoom_command.h"

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
  app.add_option("--resolution", o.resolution_arcsec,
                 "[arcsec] of a count, as the unit prints it (PR, TR); 11.5714 if not stated; an "
                 "instrument's own counts of a turn come first")
      ->check(CLI::Range(0.1, 1000.0));
  add_ut1(app, o.ut1);
  app.add_option("--clock-sd", o.clock_sd_s,
                 "[s] 1-sigma of the clock that stamped stars and sun; 0.05 if not stated")
      ->check(CLI::Range(1e-6, 10.0));
  app.add_option("--pressure", o.pressure_hPa, "[hPa] at the station, for stars and the sun")
      ->check(CLI::Range(300.0, 1200.0));
  app.add_option("--temperature", o.temperature_degC, "[degC] for stars and the sun")
      ->check(CLI::Range(-60.0, 60.0));
}

void add_aircraft_options(CLI::App& app, calibration::AircraftOptions& o) {
  app.add_option("--input", o.inputs, "files, or HOST:PORT of a receiver; several are read in turn")
      ->required();
  app.add_option("--format", o.format, "beast (30005), sbs (30003) or json (aircraft.json)")
      ->check(CLI::IsMember({"beast", "sbs", "json"}))
      ->required();
  app.add_option("--output", o.output, "CSV for --references; it must be new")->required();
  app.add_option("--sd", o.sd_m, "[m] of each coordinate of a position")
      ->check(CLI::Range(1.0, 1000.0));
  app.add_option("--duration", o.duration_s, "[s] for which a receiver is listened to")
      ->check(CLI::Range(1.0, 86400.0));
  app.add_option("--start-utime", o.start_utime_us,
                 "[us] UTC of the first frame of a Beast file, which has no time of day");
  app.add_flag("--geometric", o.heights_are_geometric,
               "the receiver is set up to write heights above the ellipsoid to SBS");
  app.add_flag("--clock-is-right", o.clock_is_right,
               "of a connection: take the clocks of this computer and of the receiver as right, "
               "although no time service says so");
}

void add_camera_options(CLI::App& app, calibration::CameraOptions& o) {
  app.add_option("--pictures", o.pictures, "pictures of one board: ten or more, from all sides")
      ->required();
  app.add_option("--board", o.shape.kind, "chessboard, charuco or apriltag")
      ->check(CLI::IsMember({"chessboard", "charuco", "apriltag"}));
  app.add_option("--columns", o.shape.columns,
                 "corners in a row of a chessboard, squares of a ChArUco, tags")
      ->required();
  app.add_option("--rows", o.shape.rows, "rows of corners, of squares, of tags")->required();
  app.add_option("--square", o.shape.square_m, "[m] edge of a square; from one tag to the next")
      ->check(CLI::Range(1e-4, 10.0));
  app.add_option("--marker", o.shape.marker_m, "[m] edge of a ChArUco's marker, of a tag");
  app.add_option("--lens", o.model, "model of the lens: pinhole, fisheye or polynomial")
      ->transform(CLI::CheckedTransformer(
          std::map<std::string, ols::LensModel>{{"pinhole", ols::LensModel::kPinhole},
                                                {"fisheye", ols::LensModel::kFisheye},
                                                {"polynomial", ols::LensModel::kPolynomial}}));
  app.add_option("--output", o.output, "folder for the results; it must be new or empty")
      ->required();
}

void add_tracks_options(CLI::App& app, calibration::TracksOptions& o) {
  app.add_option("--station", o.stations.stations,
                 "its configuration, as ols-station reads it; all whose sightings are wanted")
      ->required();
  app.add_option("--instrument", o.stations.instruments,
                 "TOML: what is known of the instrument; else it is a new unit; one a station");
  app.add_option("--recording", o.log.recordings,
                 "log of the bus, as ols-logger writes it; several")
      ->required();
  app.add_option("--aircraft", o.aircraft,
                 "CSV of `ols-calibrate aircraft`: what flew as one of them becomes its sightings")
      ->check(CLI::ExistingFile);
  app.add_option("--least-belief", o.log.least_belief, "lowest belief of the tracker, 0 to 1")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 1.0));
  app.add_option("--output", o.output, "JSON lines for --observations; it must be new")->required();
}

constexpr const char* kExitStatus =
    "Exit status: 0 the result is within its limits and made of everything that was given; 1 it is "
    "not, or was not accepted, and the messages say why; 2 there is no result.";

// Nothing is overwritten: neither another calibration nor an input.
fs::path output_folder(const calibration::CaseOptions& o) {
  if (o.output.empty()) return calibration::checked_folder(o.output);
  std::vector<ols::NamedFile> inputs{{"--references", o.references}, {"--predict", o.predict}};
  for (const std::string& path : o.stations) inputs.push_back({"--station", path});
  for (const std::string& path : o.instruments) inputs.push_back({"--instrument", path});
  for (const std::string& path : o.observations) inputs.push_back({"--observations", path});
  ols::check_outputs(inputs, {{"--output", o.output}});
  return calibration::checked_folder(o.output);
}

// The results are written in any case: what to do about a limit is for a person to decide.
int adjust(const calibration::CaseOptions& options) {
  ols::Progress progress("ols-calibrate", "adjustments");
  std::size_t done = 0;
  const auto tell = [&] { progress(++done, 0); };
  const auto adjusted = calibration::adjust_into(options, output_folder(options), tell);
  const std::vector<std::string> bad = calibration::bad_findings(adjusted);
  const int status = calibration::tell({{}, adjusted.notes, bad});
  if (status != 0) {
    std::cerr << "ols-calibrate: not within the limits; the results are in " << options.output
              << '\n';
  }
  return status;
}

int told(const calibration::CommandReport& report) {
  const int status = calibration::tell(report);
  ols::flush_output();
  return status;
}

}  // namespace

int main(int argc, char** argv) {
  ols::remove_temporary_files_on_signals();
  CLI::App app{"Calibrates a station: its instrument, and how the tripod stands."};
  app.set_version_flag("--version", OLS_VERSION);
  app.require_subcommand(1);
  app.footer(kExitStatus);  // also of the subcommands
  calibration::CaseOptions options;
  add_options(*app.add_subcommand("adjust", "One adjustment of all observations."), options);
  calibration::ProcedureOptions procedure;
  calibration::add_procedures(app, procedure);
  calibration::ZoomOptions zoom;
  const CLI::App* zooms = calibration::add_zoom(app, zoom);
  calibration::MountOptions mount;
  const CLI::App* mounts = calibration::add_mount(app, mount);
  calibration::DelayOptions delay;
  const CLI::App* delays = calibration::add_delay(app, delay);
  calibration::SceneryOptions scenery;
  const CLI::App* measured = calibration::add_scenery(app, scenery);
  calibration::AircraftOptions aircraft;
  const CLI::App* heard =
      app.add_subcommand("aircraft", "What a receiver has heard, as references.");
  add_aircraft_options(*app.get_subcommand("aircraft"), aircraft);
  calibration::TracksOptions tracks;
  const CLI::App* followed = app.add_subcommand(
      "tracks", "What stations have followed, out of recordings, as observations.");
  add_tracks_options(*app.get_subcommand("tracks"), tracks);
  calibration::CameraOptions camera;
  const CLI::App* boards =
      app.add_subcommand("camera", "A camera that focuses near, from pictures of a board.");
  add_camera_options(*app.get_subcommand("camera"), camera);
  if (const auto status = ols::parse_command_line(app, argc, argv, "ols-calibrate")) {
    return *status;
  }
  try {
    if (!procedure.name.empty()) return calibration::run_procedure(procedure);
    if (mounts->parsed()) return calibration::run_mount(mount);
    if (delays->parsed()) return calibration::run_delay(delay);
    if (measured->parsed()) {
      const ols::Progress progress("ols-calibrate", "sectors");
      return told(calibration::write_scenery(scenery, progress));
    }
    if (zooms->parsed()) return calibration::run_zoom(zoom);
    if (heard->parsed()) {
      const ols::Progress progress("ols-calibrate", "bytes");
      return told(calibration::write_aircraft(aircraft, progress));
    }
    if (followed->parsed()) return told(calibration::write_tracks(tracks));
    if (boards->parsed()) return told(calibration::write_camera(camera));
    return adjust(options);
  } catch (const std::bad_alloc&) {
    std::cerr << "ols-calibrate: the memory does not suffice for so many observations: leave some "
                 "of them out\n";
    return ols::kExitBadInput;
  } catch (const std::exception& error) {
    std::cerr << "ols-calibrate: " << error.what() << '\n';
    return ols::kExitBadInput;
  }
}
