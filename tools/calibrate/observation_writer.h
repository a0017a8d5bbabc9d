// Writes observations.jsonl, which observation_file.h reads.
#pragma once

#include <string>
#include <vector>

#include "calibration/observation.h"

namespace ols::calibration {

// One JSON object per line.
std::string observation_lines(const std::vector<Observation>& observations,
                              const std::string& station);

}  // namespace ols::calibration
