// A recording of any length, for measures of time and memory.
#pragma once

#include <cstddef>
#include <string>

namespace ols::bench {

struct LongRecording {
  std::size_t rows = 1'000'000;
  int stations = 4;       // on a circle of 300 m, 25 exposures a second each, evenly staggered
  int targets = 1;        // number of targets that each station sees in each exposure
  bool are_named = true;  // in a column `target`
};

// Writes stations.csv and bearings.csv to a folder that exists; throws std::system_error.
void write_long_recording(const std::string& folder, const LongRecording& recording);

}  // namespace ols::bench
