// A surveyor's stationing: files in, a station's configuration out (calibration/stationing.h).
#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "calibration/stationing.h"
#include "edge/config/config.h"

namespace ols::calibration {

struct StationingOptions {
  std::string station;    // its configuration, as ols-station reads it
  std::string landmarks;  // CSV: geodetic or UTM
  std::string sightings;  // CSV
  std::string at;         // the landmark at the station's place; empty: [pose] gives it
  double pixel_sd_px = 1.0;
  double angles_sd_deg = 0.01;
  double highest_deg = 45.0;  // max elevation of targets
};

// A sighting's landmark and the line of its row.
struct SightingName {
  std::string landmark;
  unsigned line = 0;
};

struct StationingCase {
  station::StationSettings settings;
  StationGeometry rough;
  std::string path;  // of the sightings
  std::vector<SightingName> names;
  std::vector<LandmarkSighting> sightings;
};

// Throws ConfigError or CsvError (naming file, line and key or column); std::invalid_argument if
// the station's position is unknown.
StationingCase read_stationing(const StationingOptions& options);

// Throws CsvError with the names and lines concerned: landmarks that contradict each other, no
// landmarks, or landmarks that do not determine the heading.
Stationing find_station(const StationingCase& before, double highest_rad);

// The tables of the station's configuration that the stationing has determined. Comments give its
// tests, and what the landmarks determine.
void write_stationing(std::ostream& out, const StationingCase& before, const Stationing& found,
                      bool with_position);

// Warnings for standard error: one line per rejected landmark, and one if deviations were scaled.
std::vector<std::string> stationing_warnings(const StationingCase& before, const Stationing& found);

}  // namespace ols::calibration
