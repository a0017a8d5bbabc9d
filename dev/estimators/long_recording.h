// Writes a recording of any length, for measuring computing time and memory.
#pragma once

#include <cstddef>
#include <string>

namespace ols::bench {

struct LongRecording {
  std::size_t rows = 1'000'000;
  // The stations are on a circle with a radius of 300 m. Each has 25 exposures a second, evenly
  // staggered.
  int stations = 4;
  int targets = 1;        // number of targets that each station sees in each exposure
  bool are_named = true;  // the file has the column `target`
};

// Writes stations.csv and bearings.csv to a folder, which must exist. Throws std::system_error.
void write_long_recording(const std::string& folder, const LongRecording& recording);

}  // namespace ols::bench
