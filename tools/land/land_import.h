// ols-land import: collects the elevation models, buildings, woods and measured scenery of a
// site's land in one folder.
#pragma once

#include <string>
#include <vector>

namespace ols::land {

struct ImportOptions {
  double latitude_deg = 0.0, longitude_deg = 0.0;  // of the site
  double radius_km = 40.0;
  std::vector<std::string> elevation, buildings, woods, scenery;  // paths
  // The zero of the models' heights: a geoid grid of PROJ, or "ellipsoid". Empty: the zero that the
  // kind of file implies; a file that implies none is refused.
  std::string heights;
  double sd_m = 4.0;  // 1-sigma of the models' heights
  std::string licence;
  bool accept_seams = false;
  std::string output;
};

// Returns a description of the land for people; the manifest has the same text. Throws
// std::runtime_error.
std::vector<std::string> import_land(const ImportOptions& options);

}  // namespace ols::land
