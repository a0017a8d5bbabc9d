// Sends a probe for ONVIF cameras to all networks of this computer, by multicast over IPv4.
#pragma once

#include "edge/mount/onvif/discovery.h"

namespace ols::onvif {

// Sends the probe and collects answers for a time of `seconds`. Throws std::system_error if the
// probe cannot be sent to any network.
Discovery look_for_cameras(double seconds);

}  // namespace ols::onvif
