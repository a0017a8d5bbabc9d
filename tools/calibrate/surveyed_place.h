// Converts the coordinates in a row of a surveyor's file to a position.
#pragma once

#include <stdexcept>
#include <string>
#include <variant>

#include "base/files/csv_files.h"
#include "geometry/angles.h"
#include "geometry/utm.h"
#include "geometry/wgs84.h"

namespace ols::calibration {

// `row`: of read_survey() or read_references(). Throws CsvError if the UTM zone does not exist or
// the coordinates are outside of it.
template <class Row>
Geodetic surveyed_place(const Row& row, const std::string& path) {
  if (const auto* place = std::get_if<GeodeticCells>(&row.place)) {
    return {radians(place->latitude_deg), radians(place->longitude_deg), row.height_m};
  }
  const auto& utm = std::get<UtmCells>(row.place);
  try {
    return geodetic_from_utm({utm.zone, utm.northern, utm.easting_m, utm.northing_m}, row.height_m);
  } catch (const std::invalid_argument& error) {
    throw CsvError(path + ":" + std::to_string(row.line) + ": easting_m: " + error.what());
  }
}

}  // namespace ols::calibration
