// GeoJSON (RFC 7946): heights above the WGS84 ellipsoid. Pure.
#pragma once

#include <string>

#include "export/files/picture.h"

namespace ols::exports {

// A point for each target with its track as a line, a point for each station, and a line of
// `line_m` for a station's last bearing. Covariances are properties.
std::string geojson(const Picture& picture, double line_m);

}  // namespace ols::exports
