// KML 2.2 for Google Earth and its like: heights above the sea ("absolute"). Pure.
#pragma once

#include <string>

#include "export/files/picture.h"

namespace ols::exports {

// Tracks in time (gx:Track), stations, and the lines on which stations saw something last.
std::string kml(const Picture& picture, double line_m);
// A document that shows the other file, and reads it again at this interval.
std::string kml_link(const std::string& file, double interval_s);

}  // namespace ols::exports
