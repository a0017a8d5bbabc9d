// A scenario's ONVIF PTZ camera at a station. Pure.
#pragma once

#include "sim/onvif/config.h"
#include "sim/scenario/scenario.h"

namespace ols::sim {

OnvifConfig onvif_config(const Scenario& scenario, const StationScenario& station);

// The address of the video of this station's camera, whether the camera is an ONVIF camera or
// another RTSP camera.
std::string stream_address(const StationScenario& station);

}  // namespace ols::sim
