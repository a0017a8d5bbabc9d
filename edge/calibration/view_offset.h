// Measures how far a camera's direction has turned since a stored picture of the same view. Pure.
#pragma once

#include <opencv2/core.hpp>
#include <optional>

#include "edge/calibration/drift_finding.h"
#include "geometry/station_model.h"

namespace ols::station {

// A picture, and the angles that the unit reported for it.
struct View {
  cv::Mat gray;
  PanTilt reported;
};

// How far the camera has turned from `stored` to `seen`, minus the difference of the reported
// angles. nullopt if the stored picture is not recognised. `angle_sd_rad`: 1-sigma of each angle at
// a stop of the unit.
std::optional<ViewOffset> offset_of(const View& stored, const View& seen,
                                    const StationGeometry& geometry, double angle_sd_rad);

}  // namespace ols::station
