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

// A sighting's landmark and the line of its row.
struct SightingName {
  std::string landmark;
  unsigned line = 0;
};

struct StationingCase {
  StationSettings settings;
  StationGeometry rough;
  std::string path;  // of the sightings
  std::vector<SightingName> names;
  std::vector<LandmarkSighting> sightings;
};

// ConfigError, CsvError (both name file, line and key or column); std::invalid_argument where the
// station's place is not known.
StationingCase read_stationing(const StationingOptions& options);

// CsvError: the landmarks contradict each other, are none or leave the heading unknown; with the
// names and lines of those that do.
Stationing find_station(const StationingCase& before, double highest_rad);

// The tables of the station's configuration that the stationing has found, with its tests, and
// what the landmarks determine, as comments.
void write_stationing(std::ostream& out, const StationingCase& before, const Stationing& found,
                      bool with_position);

// Of what was set aside and scaled, a line each, for those who do not look into the output.
std::vector<std::string> stationing_warnings(const StationingCase& before, const Stationing& found);

}  // namespace ols
