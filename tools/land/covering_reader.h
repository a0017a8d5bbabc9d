// Reads buildings and woods from any vector file that GDAL can read: GeoJSON, OSM, GeoPackage.
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

// Reads the polygons within the bounds. Heights are above the ground. A height comes from the
// attribute `height`, in metres unless it states feet. Without this attribute, the height is 3 m
// for each storey in `building:levels` or `levels`. A feature without any of these attributes, or
// with an implausible height or place, is left out and noted. Throws std::runtime_error naming a
// file that cannot be read.
ReadCoverings read_coverings(const std::string& path, CoveringKind kind, const Bounds& bounds);

// Converts texts such as "12", "12.5 m", "40 ft" or "40'" to metres; NaN for any other text.
double parse_height_m(const std::string& text);

}  // namespace ols::land
