// The CSV file of scenery that two stations have measured: `ols-calibrate scenery` writes it,
// `ols-land import` reads it. Conventions as in base/files/csv_files.h.
#pragma once

#include <string>
#include <vector>

#include "geometry/angles.h"

namespace ols::land {

// A point of the scenery, and how the first station sees it.
struct SceneryRow {
  std::string station, other;
  double latitude_deg = 0.0, longitude_deg = 0.0;
  double height_m = 0.0;  // above the WGS84 ellipsoid
  double height_sd_m = 0.0;
  double azimuth_deg = 0.0, elevation_deg = 0.0;  // apparent
  double range_m = 0.0;
  double range_sd_m = 0.0;             // 1-sigma, its own for each point
  double range_sd_systematic_m = 0.0;  // 1-sigma, from the poses; all ranges of a pair err alike
};

inline constexpr double kSceneryWide_rad = radians(0.1);  // two columns of a map

// Throws std::system_error naming the file.
void write_scenery(const std::string& path, const std::vector<SceneryRow>& rows);
// Reads at least one row. Throws CsvError.
std::vector<SceneryRow> read_scenery(const std::string& path);

}  // namespace ols::land
