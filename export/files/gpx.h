// GPX 1.1: a track for each target, a waypoint for each station. Heights above sea level, with the
// geoid's height there. It has no fields for uncertainties and lines. Pure.
#pragma once

#include <string>

#include "export/files/picture.h"

namespace ols::exports {

std::string gpx(const Picture& picture);

}  // namespace ols::exports
