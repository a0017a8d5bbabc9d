// Reads stations.csv and bearings.csv as input of the fusion.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "central/offline/bearing_pointers.h"

namespace ols::offline {

struct RecordedBearings {
  std::vector<fusion::BearingMeasurement> bearings{};  // in the order of the file
  // The names in the column `target`, numbered from 0, and the number of each bearing's name. Empty
  // if the file has no such column.
  std::vector<std::string> targets{};
  std::vector<std::uint32_t> target_of{};
};

// Throws CsvError, also if the angles can only be radians, despite the names of the columns; and
// std::invalid_argument if a station stands where it cannot see what the others see.
RecordedBearings read_recorded_bearings(const std::string& stations_path,
                                        const std::string& bearings_path);

// The bearings of each target, sorted by name. If the file names none, there is one target "1".
struct RecordedTarget {
  std::string name;
  fusion::MutableBearings bearings{};
};
std::vector<RecordedTarget> targets_of(RecordedBearings& recording);

}  // namespace ols::offline
