// COURAGEOUS (format 0.4.1, CWA 18150), a JSON format for comparing counter-drone systems. Targets
// become tracks of the format, stations' bearings become detections. Heights are above sea level.
// The format has no fields for uncertainties. Pure.
#pragma once

#include <cmath>
#include <string>

#include "export/files/picture.h"

namespace ols::exports {

// The place of the whole system; if unknown, the place of one station is written.
struct CourageousSettings {
  double latitude_deg = kUnknown, longitude_deg = kUnknown, height_above_sea_m = kUnknown;

  bool has_place() const {
    return std::isfinite(latitude_deg + longitude_deg + height_above_sea_m);
  }
};

// Writes the document. Empty while no station is known and no place is configured, because the
// format requires a place.
std::string courageous(const Picture& picture, const std::string& site,
                       const CourageousSettings& settings);

}  // namespace ols::exports
