// Finds pairs of landmarks whose positions were exchanged by mistake.
#pragma once

#include <string>
#include <vector>

#include "calibration/calibrate.h"

namespace ols::calibration {

// One sentence for each pair of rejected landmarks that agree with all other observations if their
// positions are exchanged.
std::vector<std::string> exchanged_landmarks(const Problem& problem, const Adjustment& adjustment,
                                             const Calibration& found, const Levels& levels = {});

}  // namespace ols::calibration
