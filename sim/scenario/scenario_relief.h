// The keys of a scenario's land: [relief].
#pragma once

#include "base/config/config_section.h"
#include "sim/world/relief.h"

namespace ols::sim {

config::Section relief_section(ReliefScenario& relief);

}  // namespace ols::sim
