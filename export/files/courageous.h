// COURAGEOUS, the JSON by which counter-drone systems are compared (format 0.4.1, CWA 18150):
// targets are its tracks, what stations see its detections. Heights above the sea. It has no room
// for uncertainties. Pure.
#pragma once

#include <string>

#include "export/files/picture.h"

namespace ols::exports {

// Empty while nothing is known: the format demands a place of the system.
std::string courageous(const Picture& picture, const std::string& site);

}  // namespace ols::exports
