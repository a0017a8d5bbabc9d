// Asks the networks of this host for ONVIF cameras: multicast over IPv4.
#pragma once

#include "edge/mount/onvif/discovery.h"

namespace ols::onvif {

// Waits for answers for so many seconds. Throws std::system_error if no network can be asked.
Discovery look_for_cameras(double seconds);

}  // namespace ols::onvif
