// Reads stations.csv and bearings.csv as input for the fusion.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "central/offline/bearing_pointers.h"

namespace ols::offline {

struct RecordedBearings {
  std::vector<fusion::BearingMeasurement> bearings{};  // in the order of the file
  // The names in the column `target`, and, for each bearing, the index of its name. Both are empty
  // if the file has no such column.
  std::vector<std::string> targets{};
  std::vector<std::uint32_t> target_of{};
};

// Throws CsvError, also if the angles must be radians although the columns' names say degrees.
// Throws std::invalid_argument if a station is so far from the others that they cannot see the same
// targets.
RecordedBearings read_recorded_bearings(const std::string& stations_path,
                                        const std::string& bearings_path);

// The bearings of each target, sorted by name. If the file has no names, there is one target "1".
struct RecordedTarget {
  std::string name;
  fusion::MutableBearings bearings{};
};
std::vector<RecordedTarget> targets_of(RecordedBearings& recording);

}  // namespace ols::offline
