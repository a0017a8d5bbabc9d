#include "tools/calibrate/procedure_commands.h"

#include <cstdio>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "base/process/clocks.h"
#include "base/process/command_line.h"
#include "base/process/shutdown.h"
#include "base/trust/trust_options.h"
#include "tools/calibrate/calibration_store.h"
#include "tools/calibrate/config_change.h"
#include "tools/calibrate/procedure_end.h"
#include "tools/calibrate/procedure_stages.h"
#include "tools/calibrate/rectify.h"
#include "tools/calibrate/session_options.h"

namespace ols::calibration {
namespace {

namespace fs = std::filesystem;

void add_common(CLI::App& app, ProcedureOptions& o) {
  add_station(app, o.station);
  add_state(app, o.state_folder);
}

void add_script(CLI::App& app, ProcedureOptions& o) {
  app.add_option("--lcm-url", o.lcm_url, "bus of the site; else the station's")
      ->envname("LCM_DEFAULT_URL");
  trust::add_trust_options(app, o.trust);
  app.add_option(
      "--script", o.script,
      "answers, one a line: confirm, point X Y, exactly X Y, turn PAN TILT, skip, accept, "
      "redo, keep, abort, again, filter_on, filter_off, sight, done; else the terminal and the "
      "bus");
}

void add_live(CLI::App& app, ProcedureOptions& o) {
  add_script(app, o);
  app.add_flag("--overcast", o.overcast,
               "the sun does not show: the unit need not keep 8 degrees away from it");
  app.add_option("--sweep-poses", o.sweep_poses, "pictures of the automatic sweep; 0: none")
      ->check(CLI::Range(0, 400));
}

void add_instrument(CLI::App& app, ProcedureOptions& o) {
  app.add_option("--instrument", o.instrument,
                 "TOML: what is known of the instrument; 'new': nothing; else that which was "
                 "accepted last");
}

void add_resume(CLI::App& app, ProcedureOptions& o) {
  app.add_option("--resume", o.resume,
                 "resumes an interrupted procedure: its folder, or the newest one; all other "
                 "options are those with which it was begun")
      ->expected(0, 1);
}

void add_references(CLI::App& app, ProcedureOptions& o) {
  app.add_option("--references", o.references, "CSV: landmarks, as `adjust` reads them");
  app.add_option("--stars", o.stars, "pictures of the night sky, automatically; 24 are good")
      ->check(CLI::Range(0, 200));
  add_instrument(app, o);
  app.add_option("--rounds", o.rounds, "how often each landmark is sighted")
      ->check(CLI::Range(1, 20));
  app.add_flag("--sun", o.sun,
               "the sun, through a filter that a person puts on; it must stand 10 degrees high");
  app.add_option(
      "--drone", o.drone,
      "name of a drone with RTK, whose positions are in --references, or are appended to "
      "it while it flies");
  app.add_option("--drone-points", o.drone_points, "where it is to hover; 40 are good")
      ->check(CLI::Range(1, 400));
  add_resume(app, o);
  add_ut1(app, o.ut1);
  app.add_option("--pressure", o.pressure_hPa, "[hPa] at the station, for stars")
      ->check(CLI::Range(300.0, 1200.0));
  app.add_option("--temperature", o.temperature_degC, "[degC] for stars")
      ->check(CLI::Range(-60.0, 60.0));
}

CLI::App* add(CLI::App& app, ProcedureOptions& o, const char* name, const char* help) {
  CLI::App* command = app.add_subcommand(name, help);
  command->callback([&o, name] { o.name = name; });
  add_common(*command, o);
  return command;
}

std::string day_of(std::int64_t utime_us) {
  const std::time_t seconds = utime_us / 1'000'000;
  std::tm utc{};
  ::gmtime_r(&seconds, &utc);
  char text[40];
  std::strftime(text, sizeof text, "%Y-%m-%d %H:%M:%SZ", &utc);
  return text;
}

int show_history(const CalibrationStore& store) {
  const auto current = store.current();
  for (const HistoryLine& line : store.history()) {
    std::printf("%s  %-9s %-20s %s%s\n", day_of(line.utime_us).c_str(), line.event.c_str(),
                line.id.c_str(), line.procedure.c_str(),
                current == line.id && line.event != "kept" ? "  (in use)" : "");
  }
  if (!current) std::printf("no calibration is in use\n");
  for (const fs::path& one : store.interrupted()) {
    const bool can_go_on = fs::exists(one / kSessionFile);
    std::printf("interrupted: %s%s\n", one.c_str(), can_go_on ? " (resume it: --resume)" : "");
  }
  return 0;
}

int revert(CalibrationStore& store, const std::string& to) {
  store.lock();
  const auto target = to.empty() ? store.previous() : std::optional(to);
  if (!target) throw std::invalid_argument("there is no calibration before the one in use");
  const auto instrument = store.instrument_file();
  store.use(*target, {clock_utime_us(), "reverted", "", "", ""});
  std::printf("in use: %s\n", (store.folder() / *target).c_str());
  if (instrument && store.instrument_file() != instrument) {
    std::printf("the instrument that was accepted since is no longer used\n");
  }
  return 0;
}

void tell_dead(const std::vector<fs::path>& dead, Person& person) {
  for (const fs::path& one : dead) {
    person.tell("! a procedure was interrupted; its observations are kept in " + one.string());
  }
}

fs::path interrupted_folder(const std::string& wanted, const std::string& procedure,
                            const CalibrationStore& store) {
  const auto all = store.interrupted();
  for (auto one = all.rbegin(); one != all.rend(); ++one) {
    const bool is_it = wanted.empty()
                           ? one->filename().string().find("-" + procedure) != std::string::npos
                           : one->filename() == fs::path(wanted).filename();
    if (is_it) return *one;
  }
  throw std::invalid_argument("--resume: " + store.folder().string() + " has no interrupted " +
                              (wanted.empty() ? procedure : "'" + wanted + "'"));
}

std::string text_of(const fs::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

int carry_out(const ProcedureOptions& options, const StationFiles& station, StationLink& link,
              ProcedureSession& session, CalibrationStore& store, Person& person) {
  ProcedureRunner runner(options.name, link, person, &session);
  using M = ols_msg::procedure_t;
  try {
    const bool rectifies = options.name == "rectify";
    Procedure procedure = rectifies ? make_rectification(options, station, link, session)
                                    : make_procedure(options, station, session);
    if (!rectifies) procedure.plan(station, link, person);
    const Outcome outcome = procedure.run(runner, person);
    link.release();
    const int status = finish(procedure, outcome, station, link, store, person);
    runner.announce(outcome == Outcome::kAccepted  ? M::STATE_ACCEPTED
                    : outcome == Outcome::kKeptOld ? M::STATE_KEPT_OLD
                                                   : M::STATE_ABORTED,
                    status == 0 ? "accepted" : "the old calibration stays in use");
    return status;
  } catch (const StationStopped& stop) {  // whoever has stopped it releases it
    runner.announce(M::STATE_FAILED, stop.what());
    fail(stop, session, store);
  } catch (const std::exception& error) {
    link.release();
    runner.announce(M::STATE_FAILED, error.what());
    fail(error, session, store);
  }
}

// At once, and not after the sightings.
void check_pressure(const ProcedureOptions& options, const StationFiles& station) {
  if (!options.pressure_hPa) return;
  const std::string trouble =
      pressure_trouble(*options.pressure_hPa, station.settings.station.geometry.position.height_m);
  if (!trouble.empty()) throw std::invalid_argument("--pressure: " + trouble);
}

int run_live(const ProcedureOptions& asked, CalibrationStore& store) {
  install_shutdown_handler();
  Person person(asked.script);
  tell_dead(store.lock(), person);
  ProcedureOptions options = asked;
  fs::path interrupted;
  if (asked.resume) {
    interrupted = interrupted_folder(*asked.resume, asked.name, store);
    const fs::path file = interrupted / kSessionFile;
    if (!fs::exists(file)) {
      throw std::invalid_argument("--resume: " + interrupted.string() + " has no " + kSessionFile +
                                  ": it cannot be resumed");
    }
    options = resumed_options(text_of(file), asked, file.string());
  }
  const StationFiles station = read_station(options);
  check_pressure(options, station);
  LcmBus bus(options.lcm_url.empty() ? station.settings.lcm_url : options.lcm_url,
             StationLink::open_trust(options.trust));
  StationLink link(bus, station.settings.id);
  check_station(link, station, options, person);
  ProcedureSession session(
      asked.resume ? store.resume(interrupted) : store.begin(options.name, clock_utime_us()),
      station.settings.id);
  return carry_out(options, station, link, session, store, person);
}

}  // namespace

void add_ut1(CLI::App& app, Ut1Value& ut1) {
  app.add_option("--ut1-utc", ut1.minus_utc_s, "[s] UT1 - UTC, for stars and the sun")
      ->check(CLI::Range(-1.0, 1.0));
  app.add_option("--ut1-date", ut1.date, "YYYY-MM-DD, the day which that value is of")
      ->check(CLI::Validator(date_problem, "DAY"));
}

void add_procedures(CLI::App& app, ProcedureOptions& options) {
  CLI::App* field = add(app, options, "field",
                        "Calibrates a station that has just been set up: sweep, landmarks, result. "
                        "A person confirms.");
  add_live(*field, options);
  add_references(*field, options);
  CLI::App* workshop =
      add(app, options, "workshop",
          "The same for a new unit: nothing is known of the instrument, more rounds.");
  add_live(*workshop, options);
  add_references(*workshop, options);
  CLI::App* rectify =
      add(app, options, "rectify",
          "How the camera is mounted, from the paper's targets: level line, crosses, two rulers.");
  add_script(*rectify, options);
  add_instrument(*rectify, options);
  rectify->add_option("--targets", options.targets, "TOML: the targets and where they stand")
      ->required();
  rectify->add_option("--rounds", options.rounds, "pictures of each target from each side")
      ->check(CLI::Range(1, 20));
  CLI::App* sweep = add(app, options, "sweep",
                        "Pictures all around, automatically: the panorama, and a check of lens and "
                        "gears against the calibration in use. What it finds can be accepted as "
                        "the instrument with which the next `field` begins.");
  add_live(*sweep, options);
  add_resume(*sweep, options);
  CLI::App* check = add(app, options, "check",
                        "Looks at up to six views of the panorama again: has the tripod moved?");
  add_live(*check, options);
  check->add_option("--panorama", options.panorama,
                    "id of a sweep or a calibration whose pictures are compared with; else those "
                    "of the calibration in use");
  add(app, options, "history", "The calibrations of a station, and which one is in use.");
  add(app, options, "revert", "Goes back to the calibration before the one in use.")
      ->add_option("--to", options.to, "id of another one");
}

int run_procedure(const ProcedureOptions& options) {
  const bool absolute = options.name == "field" || options.name == "workshop";
  if (absolute && !options.resume && options.references.empty() && options.stars == 0 &&
      !options.sun) {
    throw std::invalid_argument("--references, --stars or --sun: one is needed to find north");
  }
  if (!options.drone.empty() && options.references.empty()) {
    throw std::invalid_argument("--drone: needs --references with its positions");
  }
  const StationFiles station = read_station(options);
  CalibrationStore store(station.store);
  if (options.name == "history") return show_history(store);
  if (options.name == "revert") return revert(store, options.to);
  if (options.name == "check") {
    install_shutdown_handler();
    return run_check(options, station, store);
  }
  return run_live(options, store);
}

}  // namespace ols::calibration
