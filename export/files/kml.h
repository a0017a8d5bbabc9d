// KML 2.2 for Google Earth and similar programs, with heights above sea level ("absolute"). Pure.
#pragma once

#include <string>

#include "export/files/picture.h"

namespace ols::exports {

// Writes tracks with times (gx:Track), stations, and a line of length `line_m` [m] for each
// station's last bearing.
std::string kml(const Picture& picture, double line_m);
// Writes a document that refers to another file; a viewer that opens this document reads the other
// file again at this interval.
std::string kml_link(const std::string& file, double interval_s);

}  // namespace ols::exports
