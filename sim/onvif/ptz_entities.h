// The node, configuration and spaces of a simulated PTZ camera as XML by ONVIF's schema, and their
// tokens. Pure.
#pragma once

#include <string>
#include <vector>

#include "sim/onvif/config.h"

namespace ols::sim::ptz_entity {

constexpr const char *kProfile = "main", *kNode = "mount", *kConfiguration = "motion";

std::string node();
// `element`: the name of the XML element, with its prefix.
std::string configuration(const char* element);
std::string options();

// The scopes with which the device describes itself to programs that search for cameras.
std::vector<std::string> scopes(const OnvifConfig& config);

}  // namespace ols::sim::ptz_entity
