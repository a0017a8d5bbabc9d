// The parts of each procedure: the station's files, its stages, its adjustment.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "calibration/procedure/landmark_stage.h"
#include "calibration/procedure/sun_keep_out.h"
#include "tools/calibrate/adjust_command.h"
#include "tools/calibrate/calibration_store.h"
#include "tools/calibrate/procedure_commands.h"
#include "tools/calibrate/procedure_runner.h"
#include "tools/calibrate/reference_feed.h"

namespace ols::calibration {

struct StationFiles {
  std::string config;  // path
  station::StationSettings settings;
  std::filesystem::path store;
  std::string instrument_file;  // empty: a new unit
  Instrument instrument;
};

// Throws ConfigError and others naming file and key, and std::invalid_argument for different serial
// numbers.
StationFiles read_station(const ProcedureOptions& options);

// Checks the preconditions of any motion, and reports them to the person. Throws std::runtime_error
// naming the obstacle.
void check_station(StationLink& link, const StationFiles& station, const ProcedureOptions& options,
                   Person& person);

// In a procedure's folder: needed to resume it.
inline constexpr const char* kSessionFile = "session.json";

struct Procedure {
  ProcedureOptions options;
  ProcedureSession* session = nullptr;
  std::shared_ptr<ReferenceFeed> references;  // null: there are no references
  std::shared_ptr<SunKeepOut> sun;            // null: the sun is not visible
  std::unique_ptr<FieldProcedure> field;
  LandmarkStage* landmarks = nullptr;  // one of its stages; null: none
  CaseOptions files;                   // of the adjustment
  std::optional<Adjusted> adjusted;    // the last adjustment

  // Creates its stages. After this it must not be moved.
  void plan(const StationFiles& station, StationLink& link, Person& person);
  Outcome run(ProcedureRunner& runner, Person& person);
  AdjustedResult adjust();
};
CaseOptions files_of(const ProcedureOptions& options, const StationFiles& station,
                     const ProcedureSession& session);
// Without stages. Loads the data of a session that has begun.
Procedure make_procedure(const ProcedureOptions& options, const StationFiles& station,
                         ProcedureSession& session);

// The exit status. 0: nothing has moved; 1: something has, or this could not be determined.
int run_check(const ProcedureOptions& options, const StationFiles& station,
              CalibrationStore& store);

}  // namespace ols::calibration
