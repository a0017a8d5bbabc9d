// Measures how far a camera's direction has turned since a stored picture of the same view. Pure.
#pragma once

#include <opencv2/core.hpp>
#include <optional>

#include "edge/calibration/drift_finding.h"
#include "geometry/station_model.h"

namespace ols::station {

// A picture, and the angles that the unit reported.
struct View {
  cv::Mat gray;
  PanTilt reported;
};

// nullopt if the stored picture is not recognised. A difference between the reported angles does
// not count as a turn. `angle_sd_rad`: 1-sigma of each angle at a stop.
std::optional<ViewOffset> offset_of(const View& stored, const View& seen,
                                    const StationGeometry& geometry, double angle_sd_rad);

}  // namespace ols::station
