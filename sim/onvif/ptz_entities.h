// Node, configuration and spaces of a simulated PTZ as ONVIF's schema describes them, and the names
// by which they are called. Pure.
#pragma once

#include <string>
#include <vector>

#include "sim/onvif/config.h"

namespace ols::sim::ptz_entity {

constexpr const char *kProfile = "main", *kNode = "mount", *kConfiguration = "motion";

std::string node();
// `element`: its name with prefix.
std::string configuration(const char* element);
std::string options();

// What the device says of itself when it is looked for.
std::vector<std::string> scopes(const OnvifConfig& config);

}  // namespace ols::sim::ptz_entity
