// Looks for a single mistake that explains why observations contradict each other.
#pragma once

#include <string>
#include <vector>

#include "calibration/calibrate.h"

namespace ols::calibration {

// One sentence for each mistake that would explain the whole contradiction: two landmarks that were
// exchanged, or a wrong sign in the station's position. Empty if no single mistake explains it.
std::vector<std::string> causes_of_contradiction(const Problem& problem, const Levels& levels = {});

}  // namespace ols::calibration
