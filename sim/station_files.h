// Writes the configuration file of each station as a field team would: with the geometry as
// surveyed and calibrated (not the true one) and the sigmas of its errors.
#pragma once

#include <string>

#include "sim/world.h"

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

}  // namespace ols::sim
