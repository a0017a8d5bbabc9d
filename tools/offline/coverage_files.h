// A coverage as CSV, GeoTIFF and GeoJSON.
#pragma once

#include <string>
#include <vector>

#include "base/files/csv_files.h"
#include "tools/offline/coverage.h"

namespace ols::offline {

// A row for each cell: latitude_deg, longitude_deg, ground_m, one_m, two_m, and error_N_m for each
// height of N metres.
void write_coverage_csv(const std::string& path, const Coverage& coverage);

// The same columns, from ground_m on, as bands of 32-bit floats on WGS84; NaN where there is no
// value.
void write_coverage_geotiff(const std::string& path, const Coverage& coverage);

// For each height, the outlines of the area that two stations or more see (property
// `above_ground_m`); also the stations.
void write_coverage_geojson(const std::string& path, const Coverage& coverage,
                            const std::vector<StationRow>& stations);

}  // namespace ols::offline
