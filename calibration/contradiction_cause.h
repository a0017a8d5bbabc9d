// Why observations contradict each other: the one mistake without which all of them agree.
#pragma once

#include <string>
#include <vector>

#include "calibration/calibrate.h"

namespace ols::calibration {

// A sentence for each mistake that would explain all of them: two landmarks that were taken for
// each other, a sign of the station's position. Empty where there is none.
std::vector<std::string> causes_of_contradiction(const Problem& problem, const Levels& levels = {});

}  // namespace ols::calibration
