// Writes what the field team would have written: one configuration file for each station, with the
// geometry as surveyed and calibrated (not the true one) and the sigmas of what is not known of it.
#pragma once

#include <string>

#include "sim/world.h"

namespace ols::sim {

struct StationFileOptions {
  std::string lcm_url;
  std::string line_folder;  // where the simulator links the serial lines
  // What the stations remember; made. Each that is new there is left as by a team that has checked
  // the unit's reference and released it. Empty: they keep nothing.
  std::string state_folder;
};

std::string station_file(const World& world, std::size_t station,
                         const StationFileOptions& options);

// FOLDER/<station>.toml for every station; the folder is made. Throws std::system_error.
void write_station_files(const World& world, const StationFileOptions& options,
                         const std::string& folder);

}  // namespace ols::sim
