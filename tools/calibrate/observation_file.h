// Reads observations from a file that any program can write: one JSON object per line.
#pragma once

#include <istream>
#include <string>
#include <vector>

#include "calibration/observation.h"

namespace ols::calibration {

// The key `station` of a line names one of `stations`; it may be missing if there is only one.
// Throws std::runtime_error "FILE:LINE: key: what" for the first bad line, and for a file without
// lines.
std::vector<Observation> read_observations(const std::string& path,
                                           const std::vector<std::string>& stations);
// The same from a stream; errors name `path`.
std::vector<Observation> read_observations(std::istream& file, const std::string& path,
                                           const std::vector<std::string>& stations);

}  // namespace ols::calibration
