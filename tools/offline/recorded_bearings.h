// Reads stations.csv and bearings.csv as input of the fusion.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "central/measurement/bearing_measurement.h"

namespace ols::offline {

using RecordedBearings =
    std::map<std::string, std::vector<fusion::BearingMeasurement>>;  // by target id

// Throws CsvError, also if the angles can only be radians, despite the columns' names.
RecordedBearings read_recorded_bearings(const std::string& stations_path,
                                        const std::string& bearings_path);

}  // namespace ols::offline
