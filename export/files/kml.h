// KML 2.2 for Google Earth and similar programs. Heights above sea level ("absolute"). Pure.
#pragma once

#include <string>

#include "export/files/picture.h"

namespace ols::exports {

// Tracks in time (gx:Track), stations, and the lines of their last bearings.
std::string kml(const Picture& picture, double line_m);
// A document that shows the other file, and reads it again at this interval.
std::string kml_link(const std::string& file, double interval_s);

}  // namespace ols::exports
