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

// Reads the polygons within the bounds. Heights are above the ground. They come from the attribute
// `height`, which is in metres unless it has the unit of feet, or else are 3 m for each of
// `building:levels` or `levels`. A feature without these attributes, or with an implausible height
// or place, is left out and noted. Throws std::runtime_error naming a file that cannot be read.
ReadCoverings read_coverings(const std::string& path, CoveringKind kind, const Bounds& bounds);

// Converts texts such as "12", "12.5 m", "40 ft" or "40'" to metres; NaN for any other text.
double parse_height_m(const std::string& text);

}  // namespace ols::land
