// How a simulated ONVIF device answers those who look for cameras (WS-Discovery, April 2005). Pure.
#pragma once

#include <optional>
#include <string>

#include "sim/onvif/config.h"

namespace ols::sim {

// nullopt: the datagram is no probe, or asks for another kind of device.
std::optional<std::string> probe_answer(const std::string& datagram, const OnvifConfig& config);

}  // namespace ols::sim
