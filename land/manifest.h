// The two JSON files in a folder of `ols-land import`: land.json, the manifest, and coverings.json
// (docs/land.md).
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "land/coverings.h"

namespace ols::land {

struct Source {
  std::string file, kind;  // kind: "elevation", "buildings", "woods" or "scenery"
  std::string licence;     // as the user of `ols-land import` stated it; for people
  std::string heights;     // the reference of the heights: a geoid's grid, "ellipsoid" or "ground"
  double sd_m = 0.0;       // 1-sigma of a height, as the user stated it
};

struct GridFile {  // little-endian floats, in the order of HeightGrid
  std::string file, sha256;
  double north_deg = 0.0, west_deg = 0.0, step_latitude_deg = 0.0, step_longitude_deg = 0.0;
  int rows = 0, columns = 0;
  double sd_m = 0.0;
};

struct Manifest {
  // The centre and the radius of the site.
  double latitude_deg = 0.0, longitude_deg = 0.0, radius_km = 0.0;
  std::vector<Source> sources;
  std::vector<GridFile> grids;
  std::string coverings_sha256;
  std::vector<std::string> notes;  // remarks of the import, for people
};

inline constexpr int kFormatVersion = 1;

std::string to_text(const Manifest& manifest);
std::string to_text(const std::vector<Covering>& coverings);
// Both throw std::invalid_argument with the reason.
Manifest parse_manifest(std::string_view text);
std::vector<Covering> parse_coverings(std::string_view text);

}  // namespace ols::land
