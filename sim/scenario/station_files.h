// Writes the configuration file of each station as a field team would: with the surveyed and
// calibrated geometry instead of the true geometry, and with the sigmas of its errors.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geometry/station_calibration.h"
#include "sim/world/world.h"

namespace ols::sim {

struct StationFileOptions {
  std::string lcm_url;
  std::string line_folder;  // where the simulator puts the links to the serial lines
  // Folder of the stations' persisted state; the folder is created. A station without persisted
  // state starts without an emergency stop and with a trusted reference. Empty: the stations
  // persist nothing.
  std::string state_folder;
};

std::string station_file(const World& world, std::size_t station,
                         const StationFileOptions& options);

// Writes FOLDER/<station>.toml for every station; creates the folder. Throws std::system_error.
void write_station_files(const World& world, const StationFileOptions& options,
                         const std::string& folder);

// Writes the input files of `ols-calibrate adjust` for every station
// (sim/world/calibration_round.h): FOLDER/ID.toml, FOLDER/ID.observations.jsonl,
// FOLDER/ID.references.csv.
void write_calibration_rounds(const World& world, const StationFileOptions& options,
                              const std::string& folder);

// Reads the calibrations that `ols-calibrate adjust` has written into FOLDER/ID, by station;
// nullopt: the station has none. Throws like the functions of
// edge/calibration/calibration_folder.h.
std::vector<std::optional<StationCalibration>> read_calibrations(const World& world,
                                                                 const std::string& folder);

}  // namespace ols::sim
