// GPX 1.1: a track for each target, a waypoint for each station; heights above the sea, with how
// high the geoid is there. It has no room for uncertainties and lines. Pure.
#pragma once

#include <string>

#include "export/files/picture.h"

namespace ols::exports {

std::string gpx(const Picture& picture);

}  // namespace ols::exports
