// Buildings and woods from any vector file that GDAL reads: GeoJSON, OSM, GeoPackage.
#pragma once

#include <string>
#include <vector>

#include "land/coverings.h"
#include "tools/land/elevation_reader.h"

namespace ols::land {

struct ReadCoverings {
  std::vector<Covering> coverings;
  std::vector<std::string> notes;
};

// Reads the polygons within the bounds. Heights are above the ground, from the attribute `height`
// (in metres, or in feet if it says so). Without it, 3 m are taken for each of `building:levels` or
// `levels`. A feature without either, or with an absurd height or place, is left out and noted.
// Throws std::runtime_error naming a file that cannot be read.
ReadCoverings read_coverings(const std::string& path, CoveringKind kind, const Bounds& bounds);

// [m] of "12", "12.5 m", "40 ft" or "40'"; NaN for any other text.
double parse_height_m(const std::string& text);

}  // namespace ols::land
