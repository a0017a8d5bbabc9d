// By how much a camera's direction has turned against a stored picture of the same view. Pure.
#pragma once

#include <opencv2/core.hpp>
#include <optional>

#include "edge/drift/drift_finding.h"
#include "geometry/station_model.h"

namespace ols::station {

// A picture, and the angles that the unit reported for it.
struct View {
  cv::Mat gray;
  PanTilt reported;
};

// Nothing where the stored picture is not recognised. Reported angles that differ are no turn.
// `angle_sd_rad`: of each angle at a stop.
std::optional<ViewOffset> offset_of(const View& stored, const View& seen,
                                    const StationGeometry& geometry, double angle_sd_rad);

}  // namespace ols::station
