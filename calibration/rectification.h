// The results of the paper's rectification (section 4.2): three angles between camera and unit.
// They are computed from an adjustment in which the sightings of rectification targets are ordinary
// observations.
#pragma once

#include <vector>

#include "calibration/calibrate.h"

namespace ols::calibration {

struct RectifiedAngle {
  enum class Kind {
    kRoll,  // roll of the image relative to the horizon, at the level line; right side down > 0
    // Azimuth of the image centre relative to the plane perpendicular to the tilt axis; right > 0.
    kAzimuth,
    // Elevation of the image centre at the rulers, relative to the tilt that the unit counts.
    kElevation,
  };
  Kind kind = Kind::kRoll;
  double rad = 0.0, sd_rad = 0.0;
};
// As in reports: "roll", "azimuth", "elevation".
const char* to_string(RectifiedAngle::Kind kind);

// The angles whose targets the station has sighted, unless the adjustment has rejected the target.
std::vector<RectifiedAngle> rectified_angles(const Problem& problem, const Adjustment& adjustment,
                                             const Calibration& found, std::size_t station);

}  // namespace ols::calibration
