// COURAGEOUS, the JSON by which counter-drone systems are compared (format 0.4.1, CWA 18150):
// targets are its tracks, what stations see its detections. Heights above the sea. It has no room
// for uncertainties. Pure.
#pragma once

#include <cmath>
#include <string>

#include "export/files/picture.h"

namespace ols::exports {

// Where the system is; unknown: where one of its stations is.
struct CourageousSettings {
  double latitude_deg = kUnknown, longitude_deg = kUnknown, height_above_sea_m = kUnknown;

  bool has_place() const {
    return std::isfinite(latitude_deg + longitude_deg + height_above_sea_m);
  }
};

// Empty while no station is known and no place is set: the format demands a place of the system.
std::string courageous(const Picture& picture, const std::string& site,
                       const CourageousSettings& settings);

}  // namespace ols::exports
