// A surveyor's stationing: files in, a station's configuration out (geometry/stationing.h).
#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "edge/config.h"
#include "geometry/stationing.h"

namespace ols {

struct StationingOptions {
  std::string station;    // its configuration, as ols-station reads it
  std::string landmarks;  // CSV: geodetic or UTM
  std::string sightings;  // CSV
  std::string at;         // the landmark where the station stands; empty: [pose] says where
  double pixel_sd_px = 1.0;
  double angles_sd_deg = 0.01;
  double highest_deg = 45.0;  // of targets
};

struct StationingCase {
  StationSettings settings;
  StationGeometry rough;
  std::vector<std::string> names;  // of the sightings' landmarks
  std::vector<LandmarkSighting> sightings;
};

// ConfigError, CsvError (both name file, line and key or column); std::invalid_argument where the
// station's place is not known.
StationingCase read_stationing(const StationingOptions& options);

// The tables of the station's configuration that the stationing has found, with what each sighting
// is off as a comment.
void write_stationing(std::ostream& out, const StationingCase& before, const Stationing& found,
                      bool with_position);

}  // namespace ols
