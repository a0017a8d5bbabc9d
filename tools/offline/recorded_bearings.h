// stations.csv and bearings.csv as the fusion takes them.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "central/measurement/sighting.h"

namespace ols {

using RecordedBearings = std::map<std::string, std::vector<Sighting>>;  // by target id

// CsvError; also where the angles can only be radians, whatever the columns' names say.
RecordedBearings read_recorded_bearings(const std::string& stations_path,
                                        const std::string& bearings_path);

}  // namespace ols
