// Identifies the stars of observations that do not name their star.
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
  std::vector<std::string> remarks;     // what was found, for each station
  std::vector<std::size_t> false_ones;  // indices of observations that match no star of the table
};

// Gives a reference to each star observation that has none: the name of its star, "HIP n". Adds
// these stars to the problem's references, from the table. Observations with the same station,
// reading and time are one frame. False detections get no name; the caller must leave them out.
// Throws StarsUnidentified.
NamedStars name_stars(Problem& problem);

}  // namespace ols::calibration
