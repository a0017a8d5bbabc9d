// Chooses the pictures in which the skyline of the land is looked for: those of a camera at rest.
// Pure.
#pragma once

#include <deque>
#include <optional>

#include "edge/camera/frame.h"
#include "edge/frames/pointing_model.h"
#include "edge/skyline/skyline_watch.h"

namespace ols::station {

// The newest of these frames (given oldest first) for which the mount's angles are known before and
// after the exposure, with the camera's pose. nullopt if there is none, if mount or zoom moved
// during that exposure, or if the station has no position.
std::optional<skyline::StatedPicture> skyline_picture(const std::deque<camera::Frame>& frames,
                                                      const PointingModel& pointing);

}  // namespace ols::station
