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

// Polygons within the bounds. Heights are above the ground, from the attribute `height` (metres, or
// feet with their unit), else 3 m for each of `building:levels` or `levels`; a feature without
// either is left out and noted, as one with an absurd height or place is. Throws std::runtime_error
// naming a file that cannot be read.
ReadCoverings read_coverings(const std::string& path, CoveringKind kind, const Bounds& bounds);

// [m] of "12", "12.5 m", "40 ft", "40'"; NaN if it is nothing of that.
double parse_height_m(const std::string& text);

}  // namespace ols::land
