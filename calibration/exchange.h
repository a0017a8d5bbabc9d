// Finds pairs of references that were exchanged.
#pragma once

#include <string>
#include <vector>

#include "calibration/calibrate.h"

namespace ols::calibration {

// One sentence for each pair of rejected landmarks that agree with all others once their places are
// exchanged.
std::vector<std::string> exchanged_landmarks(const Problem& problem, const Adjustment& adjustment,
                                             const Calibration& found, const Levels& levels = {});

}  // namespace ols::calibration
