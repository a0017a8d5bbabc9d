// GeoJSON (RFC 7946): heights above the WGS84 ellipsoid. Pure.
#pragma once

#include <string>

#include "export/files/picture.h"

namespace ols::exports {

// A point for each target and its track as a line, a point for each station, a line of `line_m` for
// what a station saw last. Covariances are properties.
std::string geojson(const Picture& picture, double line_m);

}  // namespace ols::exports
