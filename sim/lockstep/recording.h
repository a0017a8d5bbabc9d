// The stations' sightings of a lockstep run, as ols-logger would record them.
#pragma once

#include <string>

#include "sim/lockstep/lockstep.h"

namespace ols::sim {

void write_recording(const World& world, const LockstepResult& result, const std::string& path);

}  // namespace ols::sim
