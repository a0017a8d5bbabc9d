// Writes a coverage as CSV, GeoTIFF or GeoJSON.
#pragma once

#include <string>
#include <vector>

#include "base/files/csv_files.h"
#include "tools/offline/coverage.h"

namespace ols::offline {

// One row per cell, with latitude_deg, longitude_deg, ground_m, one_m, two_m, and error_N_m for
// each height of N metres.
void write_coverage_csv(const std::string& path, const Coverage& coverage);

// The columns from ground_m on as bands of 32-bit floats, on WGS84; NaN: no value.
void write_coverage_geotiff(const std::string& path, const Coverage& coverage);

// The outlines of the area that at least two stations see, for each height (property
// `above_ground_m`), and the stations.
void write_coverage_geojson(const std::string& path, const Coverage& coverage,
                            const std::vector<StationRow>& stations);

}  // namespace ols::offline
