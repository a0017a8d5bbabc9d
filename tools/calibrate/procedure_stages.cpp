#include "tools/calibrate/procedure_stages.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "base/process/clocks.h"
#include "calibration/procedure/drone_stage.h"
#include "calibration/procedure/preconditions.h"
#include "calibration/procedure/star_stage.h"
#include "calibration/procedure/sun_stage.h"
#include "calibration/procedure/sweep_plan.h"
#include "calibration/procedure/sweep_stage.h"
#include "edge/mount/keep_out.h"
#include "tools/calibrate/config_change.h"
#include "tools/calibrate/motion_leave.h"
#include "tools/calibrate/session_options.h"

namespace ols::calibration {
namespace {

namespace fs = std::filesystem;

fs::path store_of(const ProcedureOptions& options, const station::StationSettings& settings) {
  if (!options.state_folder.empty()) return options.state_folder;
  if (settings.state_folder.empty()) {
    throw std::invalid_argument("--state: is needed: the configuration has no state_folder");
  }
  return fs::path(settings.state_folder) / "calibrations" / settings.id;
}

// The instrument of the calibration in use, unless another one is wanted.
std::string instrument_of(const ProcedureOptions& options, const fs::path& store) {
  if (options.instrument == "new") return "";
  if (!options.instrument.empty()) return options.instrument;
  if (options.name == "workshop") return "";
  const auto newest = CalibrationStore(store).instrument_file();
  return newest ? newest->string() : "";
}

// Within the unit's travel and the configured limits, and outside of keep-out regions.
SweepPlanOptions sweep_options(const ProcedureOptions& options, const StationFiles& station,
                               const ols_msg::station_status_t& status) {
  constexpr double kMargin_rad = 0.02;
  SweepPlanOptions plan;
  plan.poses = options.sweep_poses;
  const Eigen::Vector2d field = field_of_view(station.settings.station.geometry.camera);
  plan.field_of_view_rad = {field.x(), field.y()};
  plan.pan_min_rad = std::max(plan.pan_min_rad, status.pan_limits_rad[0] + kMargin_rad);
  plan.pan_max_rad = std::min(plan.pan_max_rad, status.pan_limits_rad[1] - kMargin_rad);
  plan.tilt_min_rad = std::max(plan.tilt_min_rad, status.tilt_limits_rad[0] + kMargin_rad);
  plan.tilt_max_rad = std::min(plan.tilt_max_rad, status.tilt_limits_rad[1] - kMargin_rad);
  plan.allowed = [regions = station.settings.mount->traits().limits.keep_out](
                     const PanTilt& angles) { return !mount::blocked(regions, angles); };
  return plan;
}

// The reference that a message is about, so that it can be sighted again. The longest name in it
// counts: "sign 10" is not "sign 1".
std::string named_in(const std::string& text, const ReferenceFeed& references) {
  std::string named;
  for (const Landmark& one : references.landmarks()) {
    const bool longer = one.name.size() > named.size();
    if (longer && text.find(one.name) != std::string::npos) named = one.name;
  }
  return named;
}

// While an interrupted procedure is replayed, the sun stands where it stood then.
SunKeepOut::UtcNow clock_of(const ProcedureSession& session) {
  return [&session] { return session.replayed_utime_us().value_or(clock_utime_us()); };
}

class Plan {
 public:
  Plan(Procedure& procedure, const StationFiles& station, const ols_msg::station_status_t& status,
       Person& person)
      : procedure_(procedure),
        prior_(prior_of(station.settings, station.instrument, station.config)),
        name_(station.settings.id),
        reach_(sweep_options(procedure.options, station, status)),
        person_(person) {}

  std::vector<std::unique_ptr<Stage>> stages() {
    const ProcedureOptions& options = procedure_.options;
    if (options.sweep_poses > 0) {
      stages_.push_back(std::make_unique<SweepStage>(prior_.model.geometry, plan_sweep(reach_)));
    }
    if (options.sun) add_sun();
    if (options.stars > 0) add_stars();
    if (!options.drone.empty()) add_drone();
    add_landmarks();
    return std::move(stages_);
  }

 private:
  MayGo may_go() const {
    return [reach = reach_](const PanTilt& at) {
      return at.pan_rad >= reach.pan_min_rad && at.pan_rad <= reach.pan_max_rad &&
             at.tilt_rad >= reach.tilt_min_rad && at.tilt_rad <= reach.tilt_max_rad &&
             reach.allowed(at);
    };
  }
  // Advises by everything that the procedure has observed at that moment.
  Adviser adviser(int times) const {
    Problem problem;
    problem.names = {name_};
    problem.stations = {prior_};
    if (procedure_.references) problem.references = procedure_.references->references();
    const auto observed = [procedure = &procedure_] { return procedure->field->observations(); };
    const auto planner = std::make_shared<SightingPlanner>(problem, observed, times);
    return [planner](const StationModel& model, const std::vector<Place>& places) {
      return planner->rank(model, places);
    };
  }
  void add_sun() {
    auto keep_out = procedure_.sun
                        ? procedure_.sun
                        : std::make_shared<SunKeepOut>(prior_.model, clock_of(*procedure_.session));
    stages_.push_back(std::make_unique<SunStage>(prior_.model, std::move(keep_out), may_go()));
  }
  void add_stars() {
    StarPlanOptions sky;
    sky.pictures = procedure_.options.stars;
    sky.pan_min_rad = reach_.pan_min_rad;
    sky.pan_max_rad = reach_.pan_max_rad;
    sky.highest_rad = reach_.tilt_max_rad;
    stages_.push_back(std::make_unique<StarStage>(plan_stars(sky)));
  }
  void add_drone() {
    const std::string& name = procedure_.options.drone;
    const auto positions = [feed = procedure_.references, name, person = &person_] {
      const std::string before = feed->trouble();
      feed->refresh();
      if (feed->trouble() != before && !feed->trouble().empty()) {
        person->tell("! " + feed->trouble());
      }
      return feed->trajectory(name);
    };
    const DroneOptions drone{name, procedure_.options.drone_points};
    stages_.push_back(std::make_unique<DroneStage>(prior_.model, drone, positions, clock_utime_us,
                                                   may_go(), adviser(1)));
  }
  void add_landmarks() {
    if (!procedure_.references) return;
    if (procedure_.references->landmarks().empty()) {
      if (!procedure_.options.drone.empty()) return;
      throw std::runtime_error(procedure_.options.references + ": has no landmark");
    }
    const int rounds = procedure_.options.rounds;
    auto landmarks = std::make_unique<LandmarkStage>(
        prior_.model, procedure_.references->landmarks(), rounds, adviser(rounds));
    procedure_.landmarks = landmarks.get();
    stages_.push_back(std::move(landmarks));
  }

  Procedure& procedure_;
  StationPrior prior_;
  std::string name_;
  SweepPlanOptions reach_;
  Person& person_;
  std::vector<std::unique_ptr<Stage>> stages_;
};

// With absolute paths, because it may be resumed from another folder.
ProcedureOptions as_begun(ProcedureOptions options, const StationFiles& station) {
  if (!options.references.empty()) options.references = fs::absolute(options.references).string();
  options.instrument =
      station.instrument_file.empty() ? "new" : fs::canonical(station.instrument_file).string();
  return options;
}

// If the source is gone, a resumed procedure uses its copy.
std::shared_ptr<ReferenceFeed> references_of(const ProcedureOptions& options,
                                             const fs::path& folder) {
  if (options.references.empty()) return nullptr;
  const fs::path copy = folder / "references.csv";
  const bool gone = options.resume && !fs::exists(options.references);
  return std::make_shared<ReferenceFeed>(gone ? copy : fs::path(options.references), copy);
}

// Waits for a unit or a camera that does not answer: its line may only be interrupted.
StationFacts facts_to_begin_with(StationLink& link, const std::string& station) {
  constexpr double kPatience_s = 5.0, kComesBack_s = 15.0;
  const double until_s = clock_monotonic_s() + kComesBack_s;
  for (;;) {
    const auto status = link.status(kPatience_s);
    if (!status) throw std::runtime_error("no status of " + station + " on the bus");
    const StationFacts facts = facts_of(*status);
    if ((facts.unit_works && facts.camera_works) || clock_monotonic_s() > until_s) return facts;
  }
}

}  // namespace

StationFiles read_station(const ProcedureOptions& options) {
  StationFiles station;
  station.config = config_path(options.station);
  station.settings = station::load_station_settings(station.config);
  station.store = store_of(options, station.settings);
  station.instrument_file = instrument_of(options, station.store);
  station.instrument = new_instrument(station.settings);
  if (!station.instrument_file.empty()) {
    station.instrument = carried_instrument(station.instrument_file, station.instrument);
    check_serials(station.settings.serials, station.instrument.serials, station.instrument_file);
  }
  return station;
}

void check_station(StationLink& link, const StationFiles& station, const ProcedureOptions& options,
                   Person& person) {
  StationFacts facts = facts_to_begin_with(link, station.settings.id);
  const double gap_s = link.status_gap_s();
  facts.status_gap_s = gap_s;
  const CameraIntrinsics& camera = station.settings.station.geometry.camera;
  Wanted wanted;
  wanted.status_gap_s = kReliedOn_s;
  wanted.absolute_time = options.stars > 0 || options.sun || !options.drone.empty();
  const StationModel model = prior_of(station.settings, station.instrument, station.config).model;
  const bool may_see_sun = !options.overcast && options.name != "rectify";
  wanted.sun_kept_out = may_see_sun && SunKeepOut(model, clock_utime_us).is_up();
  wanted.image_width_px = camera.width_px;
  wanted.image_height_px = camera.height_px;
  const auto all = preconditions(facts, wanted);
  for (const Precondition& one : all) {
    person.tell((one.met ? "  ok   " : one.needed ? "  FAIL " : "  note ") + one.sentence);
  }
  const std::string hindrance = first_hindrance(all);
  if (!hindrance.empty()) throw std::runtime_error(hindrance);
}

CaseOptions files_of(const ProcedureOptions& options, const StationFiles& station,
                     const ProcedureSession& session) {
  CaseOptions files;
  files.stations = {station.config};
  if (!station.instrument_file.empty()) files.instruments = {station.instrument_file};
  files.observations = {session.observations_path().string()};
  files.ut1 = options.ut1;
  files.clock_sd_s = kClockOfSky_s;
  files.pressure_hPa = options.pressure_hPa;
  files.temperature_degC = options.temperature_degC;
  return files;
}

Procedure make_procedure(const ProcedureOptions& asked, const StationFiles& station,
                         ProcedureSession& session) {
  Procedure procedure;
  procedure.options = as_begun(asked, station);
  procedure.session = &session;
  const ProcedureOptions& options = procedure.options;
  if (options.resume) {
    session.resume();
  } else {
    session.write(kSessionFile, session_text(options));
  }
  procedure.references = references_of(options, session.folder());
  const StationModel model = prior_of(station.settings, station.instrument, station.config).model;
  if (!options.overcast) procedure.sun = std::make_shared<SunKeepOut>(model, clock_of(session));
  procedure.files = files_of(options, station, session);
  if (procedure.references) procedure.files.references = procedure.references->path().string();
  return procedure;
}

void Procedure::plan(const StationFiles& station, StationLink& link, Person& person) {
  auto stages = Plan(*this, station, *link.status(0.0), person).stages();
  FieldProcedure::Redo redo;
  if (landmarks) redo = [stage = landmarks](const std::string& name) { stage->redo(name); };
  field = std::make_unique<FieldProcedure>(std::move(stages), redo);
}

Outcome Procedure::run(ProcedureRunner& runner, Person& person) {
  person.tell("The observations are kept in " + session->folder().string());
  if (sun)
    runner.keep_away([keep_out = sun](const PanTilt& at) { return keep_out->hindrance(at); });
  return runner.run(*field, [this] { return adjust(); });
}

AdjustedResult Procedure::adjust() {
  session->write_observations(field->observations());
  if (references) references->refresh();
  const fs::path folder = session->next_result();
  files.output = folder.string();
  adjusted.reset();
  try {
    adjusted = adjust_into(files, folder);
    if (!adjusted->found.headings_known && options.name != "sweep" && options.name != "rectify") {
      adjusted.reset();
      return {true, false, "the sightings do not determine where the station points", ""};
    }
    AdjustedResult result = result_for_person(*adjusted);
    if (!landmarks) result.worst.clear();
    return result;
  } catch (const std::runtime_error& error) {
    return {true, false, error.what(), ""};
  } catch (const std::invalid_argument& error) {
    AdjustedResult result{true, false, error.what(), ""};
    if (landmarks) result.worst = named_in(result.text, *references);
    return result;
  }
}

}  // namespace ols::calibration
