// The files of ols-calibrate: inputs of an adjustment, read and checked.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "calibration/calibrate.h"
#include "calibration/groups.h"
#include "edge/calibration/instrument_file.h"
#include "tools/calibrate/ut1_value.h"

namespace ols::calibration {

struct CaseOptions {
  std::vector<std::string> stations;     // configurations, as ols-station reads them
  std::vector<std::string> instruments;  // none, or one for each station
  std::vector<std::string> observations;
  std::string references, predict, output;
  Ut1Value ut1;
  std::optional<double> resolution_arcsec;  // a count, as the units print it
  std::optional<double> pressure_hPa, temperature_degC;
};

struct Case {
  CaseOptions options;
  std::vector<Instrument> instruments;  // as they were before
  Problem problem;
  std::vector<std::string> warnings;
  std::vector<std::string> files;  // of the observations, by their index
  std::set<std::size_t> mistaken;  // observations that are left out, by their index
};

// An instrument that a new setup begins with. What an earlier calibration has found (its covariance
// is in the file) was carried here since: the camera may have moved on its plate by 30 arc seconds,
// the axes by 4, beyond what was known. Sizes that somebody states himself stand.
Instrument carried_instrument(const std::string& path, const Instrument& fallback);

// The station before an adjustment. std::invalid_argument if its position is not surveyed.
StationPrior prior_of(const station::StationSettings& settings, const Instrument& instrument,
                      const std::string& path);
// Landmarks, stars and trajectories of a file; an empty path has none. CsvError.
References references_in(const std::string& path);

// The stations as they are before, nothing observed yet.
Case read_stations(const CaseOptions& options);
// ConfigError, CsvError or std::runtime_error naming file, line and key; std::invalid_argument.
Case read_case(const CaseOptions& options);

// The network of the case, without what is mistaken; an observation that is refused is named with
// its file and line.
Network network_of(const Case& what);

// Finds single sightings of drones, aircraft and tracks that contradict all others. `tell`: as
// calibrate().
void find_mistaken(Case& what, const TellAdjusted& tell = {});
// One sentence for each of the first few, with file and line.
std::vector<std::string> mistaken_in_words(const Case& what);

}  // namespace ols::calibration
