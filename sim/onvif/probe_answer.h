// The answer of a simulated ONVIF device to a program that searches for cameras (WS-Discovery,
// April 2005). Pure.
#pragma once

#include <optional>
#include <string>

#include "sim/onvif/config.h"

namespace ols::sim {

// The answer to a datagram; nullopt: it is not a probe, or asks for another kind of device.
std::optional<std::string> probe_answer(const std::string& datagram, const OnvifConfig& config);

}  // namespace ols::sim
