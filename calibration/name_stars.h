// Identifies stars that were observed without a name.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "calibration/groups.h"

namespace ols::calibration {

// The stars of a station could not be identified; what() says why.
class StarsUnidentified : public std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

struct NamedStars {
  std::vector<std::string> remarks;     // for each station, what was found
  std::vector<std::size_t> false_ones;  // indices of observations that match no star of the table
};

// Gives a reference to each star observation that has none. Each missing reference "HIP n" is
// filled in from the table. Observations with the same station, reading and time are one frame.
// False detections get no name and must be left out. Throws StarsUnidentified.
NamedStars name_stars(Problem& problem);

}  // namespace ols::calibration
