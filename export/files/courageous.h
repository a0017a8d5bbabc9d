// COURAGEOUS, the JSON by which counter-drone systems are compared (format 0.4.1, CWA 18150).
// Targets become its tracks, stations' bearings its detections. Heights are above sea level. The
// format has no fields for uncertainties. Pure.
#pragma once

#include <cmath>
#include <string>

#include "export/files/picture.h"

namespace ols::exports {

// The system's place; if unknown, the place of one of its stations.
struct CourageousSettings {
  double latitude_deg = kUnknown, longitude_deg = kUnknown, height_above_sea_m = kUnknown;

  bool has_place() const {
    return std::isfinite(latitude_deg + longitude_deg + height_above_sea_m);
  }
};

// Empty while no station is known and no place is configured: the format requires a place.
std::string courageous(const Picture& picture, const std::string& site,
                       const CourageousSettings& settings);

}  // namespace ols::exports
