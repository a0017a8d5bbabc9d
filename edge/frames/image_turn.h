// Converts the motion that two images show to a turn of the mount. Pure.
#pragma once

#include <optional>

#include "edge/tracker/image_motion.h"
#include "geometry/kinematic_chain.h"
#include "geometry/lens.h"

namespace ols::station {

struct ImageTurn {
  PanTilt turn;  // [rad]
  PanTilt sd;    // [rad] 1-sigma
};

// `angles`: of the mount in the earlier image, roughly. The scene is assumed to be far away and at
// rest. nullopt if no pan and tilt cause that motion.
std::optional<ImageTurn> image_turn(const ChainParameters& chain, const CameraIntrinsics& camera,
                                    const PanTilt& angles, const tracker::ImageMotion& motion);

}  // namespace ols::station
