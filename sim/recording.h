// What the stations of a lockstep run have told of their sightings, as ols-logger would record it.
#pragma once

#include <string>

#include "sim/lockstep.h"

namespace ols::sim {

void write_recording(const World& world, const LockstepResult& result, const std::string& path);

}  // namespace ols::sim
