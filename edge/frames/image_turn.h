// Converts the motion between two images to a turn of the mount. Pure.
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

// `angles`: the mount's approximate angles at the earlier image. The scene is assumed to be far
// away and at rest. nullopt if no turn in pan and tilt causes this motion.
std::optional<ImageTurn> image_turn(const ChainParameters& chain, const CameraIntrinsics& camera,
                                    const PanTilt& angles, const tracker::ImageMotion& motion);

}  // namespace ols::station
