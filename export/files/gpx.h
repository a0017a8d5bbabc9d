// GPX 1.1: a track for each target, a waypoint for each station. Heights are above sea level; the
// height of the geoid is stated with each. The format has no fields for uncertainties and lines.
// Pure.
#pragma once

#include <string>

#include "export/files/picture.h"

namespace ols::exports {

std::string gpx(const Picture& picture);

}  // namespace ols::exports
