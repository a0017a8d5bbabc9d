// A surveyor's stationing (calibration/stationing.h): reads files, and writes a part of a station's
// configuration.
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
  std::string at;  // the landmark on which the station stands; empty: [pose] gives its position
  double pixel_sd_px = 1.0;
  double angles_sd_deg = 0.01;
  double highest_deg = 45.0;  // max elevation of the sighted landmarks
};

// The landmark of a sighting, and its line in the file.
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

// Throws CsvError with the names and lines concerned: if the landmarks contradict each other, if
// there are none, or if they do not determine the heading.
Stationing find_station(const StationingCase& before, double highest_rad);

// Writes the tables of the station's configuration that the stationing has determined. Comments in
// these tables give the results of the stationing's tests, and what the landmarks determine.
void write_stationing(std::ostream& out, const StationingCase& before, const Stationing& found,
                      bool with_position);

// Warnings for standard error: one line per rejected landmark, and one line if the standard
// deviations were scaled.
std::vector<std::string> stationing_warnings(const StationingCase& before, const Stationing& found);

}  // namespace ols::calibration
