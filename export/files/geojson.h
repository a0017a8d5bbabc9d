// GeoJSON (RFC 7946), with heights above the WGS84 ellipsoid. Pure.
#pragma once

#include <string>

#include "export/files/picture.h"

namespace ols::exports {

// Writes a point for each target and a line for its track, a point for each station, and a line of
// length `line_m` [m] for a station's last bearing. Covariances are properties.
std::string geojson(const Picture& picture, double line_m);

}  // namespace ols::exports
