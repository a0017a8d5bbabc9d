// Writes the configuration file of each station as a field team would: with the surveyed and
// calibrated geometry (not the true one) and the sigmas of its errors.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geometry/station_calibration.h"
#include "sim/world/world.h"

namespace ols::sim {

struct StationFileOptions {
  std::string lcm_url;
  std::string line_folder;  // where the simulator links the serial lines
  // Folder of the stations' persisted state; created. New stations are released, with a checked
  // reference. Empty: nothing is persisted.
  std::string state_folder;
};

std::string station_file(const World& world, std::size_t station,
                         const StationFileOptions& options);

// FOLDER/<station>.toml for every station; creates the folder. Throws std::system_error.
void write_station_files(const World& world, const StationFileOptions& options,
                         const std::string& folder);

// The files of `ols-calibrate adjust` for every station (sim/world/calibration_round.h):
// FOLDER/ID.toml, FOLDER/ID.observations.jsonl, FOLDER/ID.references.csv.
void write_calibration_rounds(const World& world, const StationFileOptions& options,
                              const std::string& folder);

// The calibrations FOLDER/ID of `ols-calibrate adjust`, by station; nullopt where there is none.
// Throws as edge/calibration/calibration_folder.h.
std::vector<std::optional<StationCalibration>> read_calibrations(const World& world,
                                                                 const std::string& folder);

}  // namespace ols::sim
