// Observations as any program can write them: one JSON object a line.
#pragma once

#include <istream>
#include <string>
#include <vector>

#include "calibration/observation.h"

namespace ols::calibration {

// The stations by their ids: `station` of a line is one of them; it may be missing where there is
// only one. std::runtime_error "FILE:LINE: key: what" for the first bad line, or for a file without
// any.
std::vector<Observation> read_observations(const std::string& path,
                                           const std::vector<std::string>& stations);
// The same of a stream; `path` is what errors name.
std::vector<Observation> read_observations(std::istream& file, const std::string& path,
                                           const std::vector<std::string>& stations);

}  // namespace ols::calibration
