// Chooses the pictures in which the skyline of the land is searched for: those of a camera at rest.
// Pure.
#pragma once

#include <deque>
#include <optional>

#include "edge/camera/frame.h"
#include "edge/frames/pointing_model.h"
#include "edge/skyline/skyline_watch.h"

namespace ols::station {

// Returns the newest frame for which the mount's angles before and after the exposure are known,
// with the camera's pose. `frames`: oldest first. nullopt if there is no such frame, if mount or
// zoom moved during the exposure of that frame, or if the station has no position.
std::optional<skyline::StatedPicture> skyline_picture(const std::deque<camera::Frame>& frames,
                                                      const PointingModel& pointing);

}  // namespace ols::station
