// GPX 1.1: a track for each target, a waypoint for each station. Heights are above sea level; each
// point also states the height of the geoid. The format has no fields for uncertainties, and none
// for lines of sight. Pure.
#pragma once

#include <string>

#include "export/files/picture.h"

namespace ols::exports {

std::string gpx(const Picture& picture);

}  // namespace ols::exports
