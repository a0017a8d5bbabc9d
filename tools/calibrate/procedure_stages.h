// The parts of each procedure: the station's files, the procedure's stages, and its adjustment.
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
  std::string instrument_file;  // empty: the unit has no calibration yet
  Instrument instrument;
};

// Throws ConfigError and other exceptions that name file and key, and std::invalid_argument if the
// files state different serial numbers.
StationFiles read_station(const ProcedureOptions& options);

// Checks the preconditions of motion, and reports them to the person. Throws std::runtime_error
// naming the one that is not met.
void check_station(StationLink& link, const StationFiles& station, const ProcedureOptions& options,
                   Person& person);

// The file in a procedure's folder that is needed to resume it.
inline constexpr const char* kSessionFile = "session.json";

struct Procedure {
  ProcedureOptions options;
  ProcedureSession* session = nullptr;
  std::shared_ptr<ReferenceFeed> references;  // null: there are no references
  std::shared_ptr<SunKeepOut> sun;            // null: the sun is not visible
  std::unique_ptr<FieldProcedure> field;
  LandmarkStage* landmarks = nullptr;  // the stage with landmarks; null: there is none
  CaseOptions files;                   // input of the adjustment
  std::optional<Adjusted> adjusted;    // the last adjustment

  // Creates the stages. After this call, the object must not be moved.
  void plan(const StationFiles& station, StationLink& link, Person& person);
  Outcome run(ProcedureRunner& runner, Person& person);
  AdjustedResult adjust();
};
CaseOptions files_of(const ProcedureOptions& options, const StationFiles& station,
                     const ProcedureSession& session);
// Makes a procedure without stages. Loads the data of a session that has begun.
Procedure make_procedure(const ProcedureOptions& options, const StationFiles& station,
                         ProcedureSession& session);

// Takes the views stored with the calibration in use once more, and compares them. Returns the exit
// status. 0: nothing has moved; 1: something has moved, or this could not be determined.
int run_check(const ProcedureOptions& options, const StationFiles& station,
              CalibrationStore& store);

}  // namespace ols::calibration
