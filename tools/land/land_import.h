// ols-land import: everything that is known of a site's land into one folder.
#pragma once

#include <string>
#include <vector>

namespace ols::land {

struct ImportOptions {
  double latitude_deg = 0.0, longitude_deg = 0.0;  // of the site
  double radius_km = 40.0;
  std::vector<std::string> elevation, buildings, woods;  // paths
  // What the models' heights are above: a geoid's grid for PROJ, or "ellipsoid". Empty: by the kind
  // of the file, if it says so.
  std::string heights;
  double sd_m = 4.0;  // 1-sigma of the models' heights
  std::string licence;
  bool accept_seams = false;
  std::string output;
};

// Gives what was found, for people, as it stands in the manifest. Throws std::runtime_error.
std::vector<std::string> import_land(const ImportOptions& options);

}  // namespace ols::land
